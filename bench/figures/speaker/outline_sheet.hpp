#pragma once
#include <string>
#include <vector>

#include "speaker/adaptation/adapt.hpp"

namespace genio::bench {

struct OutlineDrawing {
  std::string speaker;
  Adaptation adaptation;
};

/// NAME.svg and NAME.png: every speaker's outline in the model's frame over the adapted tongue's
/// midsagittal section, with its bones.
void draw_outlines(const std::vector<OutlineDrawing>& drawings, const std::string& name);

}  // namespace genio::bench
