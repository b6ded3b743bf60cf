#include "forward/effects/effect_change.hpp"

namespace genio {

EffectChange change_by_table(const std::string& name,
                             const std::function<EffectTable(double)>& table, double first,
                             double most) {
  return {.effect = name,
          .first = first,
          .most = most,
          .truth =
              [=](ModelDescription d, double s) {
                for (const auto& [key, value] : table(s)) d.effects[name][key] = value;
                return d;
              },
          .shipped = [](ModelDescription d, double) { return d; },
          .parameters = table};
}

EffectChange change_by_number(const std::string& name, const ChangeOfNumber& n) {
  return change_by_table(
      name,
      [=](double s) {
        return EffectTable{{n.key, n.absent + s * n.unit}};
      },
      n.first, n.most);
}

}  // namespace genio
