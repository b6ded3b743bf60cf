#include "inverse/recording/curves/body_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "inverse/recording/base/confidence.hpp"
#include "inverse/recording/base/named_curve.hpp"

namespace genio {
namespace {

constexpr double least_likelihood = 0.6;  // as DeepLabCut draws its points
constexpr size_t shown_parts = 40;

/// True of what a part of a tongue may be called where none is called the tongue's.
bool is_tongue_like(const std::string& name) {
  for (const char* word : {"tip", "blade", "dorsum", "body", "root"})
    if (lower_case(name).find(word) != std::string::npos) return true;
  return false;
}

/// How far to the front a part of that name lies along the tongue; empty where the name tells not.
std::optional<double> frontness(const std::string& name) {
  constexpr std::pair<const char*, double> places[] = {{"vallecula", 0}, {"root", 0},  {"body", 1},
                                                       {"dorsum", 2},    {"blade", 3}, {"tip", 4}};
  for (const auto& [word, place] : places)
    if (lower_case(name).find(word) != std::string::npos) return place;
  return {};
}

}  // namespace

void FrontInImage::add(const std::string& name, double x) {
  const auto front = frontness(name);
  if (!front) return;
  ++count_, fronts_ += *front, xs_ += x, both_ += *front * x;
}

std::string FrontInImage::facing() const {
  const double covariance = count_ > 0 ? both_ - fronts_ * xs_ / count_ : 0;
  return covariance > 0 ? "right" : covariance < 0 ? "left" : "";
}

BodyPartTable::BodyPartTable(const std::vector<BodyPartTitle>& titles, const ReadOptions& options,
                             const TablePlace& place)
    : place_(place),
      options_(options),
      all_(parts_of(titles, place)),
      parts_(chosen(all_, options, place)),
      frames_(place) {
  if (options.role != "tongue") return;
  for (const Part& part : all_)
    if (const auto points = head_points_in(part.name); points.size() == 1)
      heads_.try_emplace(points.front(), part);
}

std::vector<BodyPartTable::Part> BodyPartTable::parts_of(const std::vector<BodyPartTitle>& titles,
                                                         const TablePlace& place) {
  std::vector<Part> parts;
  std::vector<bool> has_y;
  for (size_t c = 0; c < titles.size(); ++c) {
    const auto& [name, what] = titles[c];
    const bool same = !parts.empty() && parts.back().name == name;
    if (what == "x") parts.push_back({name, c, 0, {}}), has_y.push_back(false);
    else if (what == "y" && same) parts.back().y = c, has_y.back() = true;
    else if (what == "likelihood" && same) parts.back().likelihood = c;
    else if (!what.empty())
      place.fail(
          fmt::format("column {} of values: {}; expected x, y or likelihood of one body part",
                      c + 1, in_quotes(what)));
  }
  std::set<std::string> names;
  for (size_t k = 0; k < parts.size(); ++k) {
    if (!has_y[k]) place.fail(fmt::format("body part {} has no y", in_quotes(parts[k].name)));
    if (!names.insert(parts[k].name).second)
      place.fail(fmt::format("body part {} stands twice", in_quotes(parts[k].name)));
  }
  return parts;
}

std::vector<BodyPartTable::Part> BodyPartTable::chosen(const std::vector<Part>& all,
                                                       const ReadOptions& o,
                                                       const TablePlace& place) {
  std::vector<Part> result;
  const auto of_head = [&](const Part& part) {
    return o.role == "tongue" && !head_points_in(part.name).empty();
  };
  const auto keep = [&](const auto& fits) {
    std::copy_if(all.begin(), all.end(), std::back_inserter(result),
                 [&](const Part& part) { return fits(part.name) && !of_head(part); });
  };
  if (!o.spline.empty()) {
    keep([&](const std::string& name) {
      return lower_case(name).find(lower_case(o.spline)) != std::string::npos;
    });
  } else {
    keep([&](const std::string& name) { return is_called_for(name, o.role); });
    if (result.empty() && o.role == "tongue" &&
        std::all_of(all.begin(), all.end(),
                    [&](const Part& part) { return is_tongue_like(part.name) || of_head(part); }))
      keep([](const std::string&) { return true; });
  }
  if (!result.empty()) return result;
  std::string list;
  for (size_t k = 0; k < all.size() && k < shown_parts; ++k)
    list += (k == 0 ? "" : ", ") + in_quotes(all[k].name);
  place.fail(
      fmt::format("no body part is named for the {}; it has {}; say which with --spline "
                  "TEXT, a text that their names hold",
                  o.spline.empty() ? o.role : in_quotes(o.spline), list));
}

RowFrame BodyPartTable::numbered(const std::string& index) {
  double n = 0;
  ++rows_;
  if (!parse_number(index, n)) {
    const auto slash = index.find_last_of("/\\");
    return {rows_, "", "", slash == std::string::npos ? index : index.substr(slash + 1), {}};
  }
  if (n != std::floor(n) || n < 0 || n > 1e9)
    place_.fail(fmt::format("field 1: {} is no number of a frame", in_quotes(index)));
  if (rows_ == 1) from_zero_ = n == 0;
  RowFrame row{int(n) + (from_zero_ ? 1 : 0), "", "", "", {}};
  if (options_.rate_hz > 0) row.time_s = n / options_.rate_hz;
  return row;
}

std::optional<BodyPartTable::Seen> BodyPartTable::seen(
    const Part& part, const std::function<double(size_t)>& value) const {
  const double x = value(part.x), y = value(part.y);
  if (std::isnan(x) && std::isnan(y)) return {};
  if (std::isnan(x + y))
    place_.fail(fmt::format("body part {} has {} alone; expected x and y or neither",
                            in_quotes(part.name), std::isnan(x) ? "y" : "x"));
  double p = part.likelihood ? value(*part.likelihood) : 1;
  if (std::isnan(p)) p = 0;
  if (p < 0 || p > 1)
    place_.fail(
        fmt::format("body part {}: likelihood {:g}; expected 0 to 1", in_quotes(part.name), p));
  return Seen{x, y, p};
}

void BodyPartTable::add_head_points(const std::function<double(size_t)>& value) {
  for (const auto& [point, part] : heads_)
    if (const auto at = seen(part, value); at && at->likelihood >= least_likelihood)
      head_points_[point].emplace_back(at->x, at->y);
}

void BodyPartTable::add_row(const std::string& index, const std::function<double(size_t)>& value) {
  ContourFrame& frame = frames_.frame(numbered(index));
  frames_.count("row", 1);
  size_t dropped = 0;
  for (const Part& part : parts_) {
    const auto at = seen(part, value);
    if (!at) continue;
    ++points_;
    if (at->likelihood < least_likelihood) {
      ++dropped;
      continue;
    }
    ContourPoint& point = frame.points.emplace_back();
    point.position = {at->x, not_given, at->y}, point.kind = "curve";
    front_.add(part.name, at->x);
    point.widening = widening_by_likelihood(at->likelihood);
  }
  add_head_points(value);
  unsure_ += dropped;
  if (dropped > 0) frame.note = fmt::format("{} points of low likelihood left out", dropped);
  else if (frame.points.empty()) frame.note = "the frame is empty (no body part has a value)";
}

RawContours BodyPartTable::contours() {
  RawContours raw{{}, FileAxes{"px", front_.facing(), "down"}};
  raw.file.model_frame = false;
  raw.file.frames = frames_.take();
  raw.file.head_points = std::move(head_points_);
  auto& remarks = raw.file.remarks;
  std::string left;
  const auto is_head = [&](const Part& part) {
    return std::any_of(heads_.begin(), heads_.end(),
                       [&](const auto& head) { return head.second.x == part.x; });
  };
  for (const Part& part : all_)
    if (!is_head(part) &&
        std::none_of(parts_.begin(), parts_.end(), [&](const auto& p) { return p.x == part.x; }))
      left += (left.empty() ? "" : ", ") + part.name;
  remarks.push_back(fmt::format("{} of {} body parts are the {}'s{}{}", parts_.size(), all_.size(),
                                options_.role, left.empty() ? "" : "; left out: ", left));
  std::string heads;
  for (const auto& [point, part] : heads_) heads += (heads.empty() ? "" : ", ") + part.name;
  if (!heads.empty()) remarks.push_back("points of the head: " + heads);
  if (unsure_ > 0)
    remarks.push_back(fmt::format("{} of {} points left out: their likelihood is below {:g}",
                                  unsure_, points_, least_likelihood));
  if (from_zero_) remarks.push_back("the file counts frames from 0; they are counted from 1 here");
  return raw;
}

}  // namespace genio
