#pragma once
// What there is to know of a format of contour files. Each format is one pair of files in
// inverse/recording/{curves,sensors,scans} with a function that gives its row;
// recording/format_list.cpp lists them.

#include <functional>
#include <optional>

#include "inverse/recording/base/file_axes.hpp"

namespace genio {

/// A file as written. Where there are axes, positions are (along, across, up) in its own units and
/// directions; without them they are in the model's frame already, in metres.
struct RawContours {
  ContourFile file;
  std::optional<FileAxes> axes;
};

/// What a file shows of itself before it is read.
struct FileStart {
  std::string ending;             ///< ".pos", in small letters
  std::string bytes;              ///< the first four
  std::string line;               ///< the first that is not blank
  std::vector<std::string> more;  ///< up to three that are not blank after it
  bool sensors_named = false;     ///< the caller names sensors: a recording of flesh points
};

/// A small file of a format, whole, and what its reader has to be told.
struct FormatExample {
  std::string name;  ///< with the ending that such files have
  std::string text;
  ReadOptions options;
};

struct ContourFormat {
  FormatTraits traits;
  std::string about;  ///< for people: which programs and devices write it, in a few words
  /// True where the first bytes or the ending tell it; may be empty. Its `line` is not set.
  std::function<bool(const FileStart&)> known_by_bytes;
  /// True where the first line tells it, which is asked only when no format knows the bytes; may be
  /// empty.
  std::function<bool(const FileStart&)> known_by_line;
  /// Throws InputError naming file, line and field. The file's traits are the caller's to set.
  std::function<RawContours(const std::string& path, const ReadOptions& options)> read;
  FormatExample example;
};

}  // namespace genio
