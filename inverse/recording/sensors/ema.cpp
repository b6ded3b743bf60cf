#include "inverse/recording/sensors/ema.hpp"

#include "inverse/recording/sensors/ag501_text.hpp"
#include "inverse/recording/sensors/ag50x.hpp"
#include "inverse/recording/sensors/est_track.hpp"
#include "inverse/recording/sensors/mview.hpp"
#include "inverse/recording/sensors/ndi_wave.hpp"
#include "inverse/recording/sensors/ssff.hpp"
#include "inverse/recording/sensors/vtl_ema.hpp"
#include "inverse/recording/sensors/xrmb.hpp"

namespace genio {

const std::vector<ContourFormat>& sensor_formats() {
  static const std::vector<ContourFormat> formats = {
      ssff_format(),    mview_format(), est_track_format(), ag50x_format(),      ndi_wave_format(),
      vtl_ema_format(), xrmb_format(),  mocha_format(),     ag501_text_format(),
  };
  return formats;
}

const ContourFormat* sensor_format_of(const FileStart& start) {
  for (const ContourFormat& format : sensor_formats())
    if (format.known_by_bytes && format.known_by_bytes(start)) return &format;
  for (const ContourFormat& format : sensor_formats())
    if (format.known_by_line && format.known_by_line(start)) return &format;
  return nullptr;
}

}  // namespace genio
