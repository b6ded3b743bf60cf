// A reader answers any bytes with contours or with InputError.

#include <random>

#include "inverse/recording/format_list.hpp"
#include "tests/inverse/recording/formats_fixture.hpp"

namespace genio {
namespace {

/// The text with a few bytes changed, lost or repeated.
std::string broken(std::string text, std::mt19937& random) {
  const std::string bytes("\0\t\n\r ,;.\"-*0919eEXY\xFF\xFE\xE4", 22);
  for (unsigned k = random() % 4 + 1; k > 0 && !text.empty(); --k) {
    const size_t at = random() % text.size(), length = random() % 12 + 1;
    switch (random() % 5) {
      case 0:
        text[at] = bytes[random() % bytes.size()];
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(random() % text.size(), length * 4));
        break;
      case 3:
        text.insert(at, 1, bytes[random() % bytes.size()]);
        break;
      default:
        text.resize(at);
        break;
    }
  }
  return text;
}

TEST_F(Formats, BrokenFilesOfCurvesGiveContoursOrAReason) {
  std::mt19937 random(7);
  for (const ContourFormat& format : contour_formats()) {
    if (format.traits.content != Content::curves) continue;
    SCOPED_TRACE(format.traits.name);
    int refused = 0;
    for (int k = 0; k < 300; ++k) {
      ReadOptions o = format.example.options;
      if (k % 2 == 0) o.format = format.traits.name;
      const auto path = write(format.example.name, broken(format.example.text, random));
      try {
        const auto f = read_contours(path, o);
        EXPECT_FALSE(f.frames.empty());
      } catch (const InputError& e) {
        EXPECT_STRNE(e.what(), "");
        ++refused;
      }
    }
    EXPECT_GT(refused, 30);
  }
}

}  // namespace
}  // namespace genio
