#pragma once
// The files of one session of a device, as they are read.

#include "inverse/recording/contour_file.hpp"

namespace genio {

/// A file of a session, in metres and the device's own axes.
struct SessionFile {
  std::string path;
  ContourFile file;
  FileAxes axes;  ///< what its format says of them
};

/// What was read, or came without a file, as a session has it; errors call it `path`. Throws
/// InputError where its numbers are no tongue's.
SessionFile session_file(const std::string& path, RawContours raw, const ReadOptions& options);

/// Reads a file of a session. Throws InputError naming file and field.
SessionFile read_session_file(const std::string& path, const ReadOptions& options);

/// Reads the palate trace of the same session: in the target's units where neither its format nor
/// the caller says others.
SessionFile read_palate(const std::string& path, ReadOptions options, const SessionFile& target);

/// The same for its bite plane.
SessionFile read_bite_plane(const std::string& path, ReadOptions options,
                            const SessionFile& target);

}  // namespace genio
