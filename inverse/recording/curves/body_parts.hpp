#pragma once
// DeepLabCut's tables once they are columns and rows, whatever file they came from.

#include <functional>
#include <optional>

#include "inverse/recording/base/contour_format.hpp"
#include "inverse/recording/base/frame_rows.hpp"

namespace genio {

/// What a column of values is.
struct BodyPartTitle {
  std::string part, coordinate;  ///< "tongueTip"; x, y or likelihood
};

/// Which way the face looks in an image, by the names of the tongue's parts and where they lie.
class FrontInImage {
 public:
  void add(const std::string& name, double x);
  /// "left", "right", or "" where the names tell nothing.
  std::string facing() const;

 private:
  double count_ = 0, fronts_ = 0, xs_ = 0, both_ = 0;
};

/// The contours of a table: a row a frame, body parts that are the tongue's points, and those of
/// the head.
class BodyPartTable {
 public:
  /// Throws InputError at `place` where titles are no body parts, or none is the role's.
  BodyPartTable(const std::vector<BodyPartTitle>& titles, const ReadOptions& options,
                const TablePlace& place);
  /// A row of that index: a frame's number, or the path of its image. `value` gives that of a
  /// column from 0; NaN: missing. Throws InputError at the place.
  void add_row(const std::string& index, const std::function<double(size_t)>& value);
  RawContours contours();

 private:
  struct Part {
    std::string name;
    size_t x = 0, y = 0;
    std::optional<size_t> likelihood;
  };
  static std::vector<Part> parts_of(const std::vector<BodyPartTitle>& titles,
                                    const TablePlace& place);
  static std::vector<Part> chosen(const std::vector<Part>& all, const ReadOptions& options,
                                  const TablePlace& place);
  /// Where a row shows a part, and how likely.
  struct Seen {
    double x = 0, y = 0, likelihood = 0;
  };
  /// Empty where the row has no value of the part. Throws InputError at the place.
  std::optional<Seen> seen(const Part& part, const std::function<double(size_t)>& value) const;
  void add_head_points(const std::function<double(size_t)>& value);
  RowFrame numbered(const std::string& index);

  const TablePlace& place_;
  ReadOptions options_;
  std::vector<Part> all_, parts_;
  std::map<HeadPoint, Part> heads_;
  HeadPointTracks head_points_;
  FrameRows frames_;
  FrontInImage front_;
  int rows_ = 0;
  bool from_zero_ = false;
  size_t points_ = 0, unsure_ = 0;
};

}  // namespace genio
