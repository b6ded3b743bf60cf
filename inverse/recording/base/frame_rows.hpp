#pragma once
// The rows of a long table, sorted into frames.

#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "inverse/recording/base/contours.hpp"
#include "inverse/recording/base/table_text.hpp"

namespace genio {

/// What a row says of its frame.
struct RowFrame {
  int number = 0;
  std::string recording, speaker, label;
  std::optional<double> time_s;
};

/// Frames of different recordings or speakers are kept apart. A frame with two times or two labels,
/// or whose points are counted twice, is two that were merged: that is refused.
class FrameRows {
 public:
  explicit FrameRows(const TablePlace& place) : place_(&place) {}
  /// The frame of the row that was read last. Throws InputError naming file and line.
  ContourFrame& frame(const RowFrame& row);
  /// Notes a point of that frame; `list` tells lists apart that are counted each by itself. Throws
  /// InputError where it stood in the frame before.
  void count(const std::string& list, double point);
  /// Throws InputError where the last row's frame had ended before.
  void expect_together() const;
  /// All frames. Throws InputError where there was no row.
  std::vector<ContourFrame> take();

 private:
  using Key = std::tuple<std::string, std::string, int>;  // recording, speaker, number
  struct Seen {
    size_t index = 0;
    int first_line = 0;
    std::optional<double> time;
    std::set<std::pair<std::string, double>> points;
  };
  [[noreturn]] void refuse(const std::string& what) const;

  const TablePlace* place_;
  std::vector<ContourFrame> frames_;
  std::map<Key, Seen> seen_;
  Seen* last_ = nullptr;
  bool returned_ = false;  // the last row's frame had ended before
};

}  // namespace genio
