#include "inverse/recording/base/frame_rows.hpp"

#include <fmt/format.h>

#include <cmath>

namespace genio {

void FrameRows::refuse(const std::string& what) const {
  place_->fail(fmt::format(
      "frame {} {}; it began on line {}. Two takes? Number their frames apart, or give them a "
      "column 'recording'",
      frames_[last_->index].number, what, last_->first_line));
}

ContourFrame& FrameRows::frame(const RowFrame& row) {
  const auto [it, fresh] = seen_.try_emplace(Key(row.recording, row.speaker, row.number));
  Seen* const before = last_;
  last_ = &it->second;
  returned_ = !fresh && before != last_;
  if (fresh) {
    last_->index = frames_.size(), last_->first_line = place_->number();
    ContourFrame& frame = frames_.emplace_back();
    frame.number = row.number, frame.recording = row.recording, frame.speaker = row.speaker;
  }
  ContourFrame& frame = frames_[last_->index];
  if (!row.label.empty()) {
    if (frame.label.empty()) frame.label = row.label;
    if (frame.label != row.label)
      refuse(
          fmt::format("has two labels, {} and {}", in_quotes(frame.label), in_quotes(row.label)));
  }
  if (row.time_s) {
    if (!last_->time) last_->time = frame.time_s = *row.time_s;
    if (std::abs(*last_->time - *row.time_s) > 1e-9)
      refuse(fmt::format("has two times, {:g} s and {:g} s", *last_->time, *row.time_s));
  }
  return frame;
}

std::vector<ContourFrame> FrameRows::take() {
  if (frames_.empty()) place_->fail("the file has a header but no row");
  return std::move(frames_);
}

void FrameRows::count(const std::string& list, double point) {
  if (!last_->points.emplace(list, point).second)
    refuse(fmt::format("has point {:g} twice", point));
}

void FrameRows::expect_together() const {
  if (returned_) refuse("goes on after another frame");
}

}  // namespace genio
