#pragma once
// What AAA's exports share: the columns before the knots, and which knots can be a tongue's.

#include <map>
#include <optional>

#include "inverse/recording/base/contour_format.hpp"
#include "inverse/recording/base/table_text.hpp"

namespace genio {

/// Where a row says what was recorded.
struct AaaColumns {
  std::optional<size_t> speaker, recording, time, label;
};

AaaColumns aaa_columns(const std::vector<std::string>& titles);

/// A frame of that number with what the row says of it. Throws InputError where text stands in
/// place of a time or a date.
ContourFrame aaa_frame(int number, const AaaColumns& columns,
                       const std::vector<std::string>& fields, TableNumbers& numbers,
                       const TableLines& lines);

/// One knot as read. Its place is its number along the spline, missing ones counted.
struct AaaKnot {
  double x = 0, y = 0;  // [mm]
  std::optional<double> confidence;
  double widening = 1;  // of the noise, by the confidence
  size_t place = 0;
};

/// Counts of what was left out of a file, for its remarks.
struct AaaLosses {
  int knots = 0, far = 0, far_frames = 0, unsure = 0;
};

/// Adds the knots to the frame but for those of a confidence below `least`, and those of a tongue
/// that lie beyond a gap no tongue has. The frame's note says what was left out.
void add_knots(ContourFrame& frame, const std::vector<AaaKnot>& knots, double least, bool tongue,
               AaaLosses& losses);

/// What a row's splines show of the head, by name and number of knots: of "DLC_HyoidMandible" each
/// of its two, and of the hyoid alone the middle of all. The first spline that shows a point
/// counts.
class AaaHeadPoints {
 public:
  void add(const std::string& spline, const std::vector<AaaKnot>& knots, size_t count,
           double least);
  void add_to(HeadPointTracks& tracks) const;

 private:
  std::map<HeadPoint, Eigen::Vector2d> seen_;
};

void remark_losses(ContourFile& file, const AaaLosses& losses, double least);

}  // namespace genio
