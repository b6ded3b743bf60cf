#pragma once
// A speaker's midsagittal outline as a file gives it.

#include <map>
#include <string>
#include <vector>

#include "inverse/target/tongue_line.hpp"

namespace genio {

/// The structures that an outline may name.
enum class Segment { tongue, palate, mandible, hyoid, pharynx, epiglottis };

/// "tongue", "palate", ... as messages name it.
std::string segment_name(Segment segment);

/// Lines of one speaker in the midsagittal plane, in metres and the model's axes: x backwards, z
/// up. The origin is the file's own.
struct SpeakerOutline {
  std::string source;   ///< the file's path, for messages
  std::string speaker;  ///< as the file names it; empty where it names none
  std::map<Segment, std::vector<Vec2>> segments;
  /// The tongue's line is its free surface alone, from the floor of the mouth over tip and dorsum
  /// to the vallecula. Else it runs from the hyoid along the floor to the mandible first.
  bool free_surface_only = false;
  bool mirrored = false;           ///< x was turned, as the outline faced the other way
  std::vector<std::string> notes;  ///< what was turned or taken for granted, one sentence each

  const std::vector<Vec2>& tongue() const { return segments.at(Segment::tongue); }
  bool has(Segment s) const { return segments.contains(s); }
  /// "FILE, speaker 3" for messages.
  std::string name() const;
};

/// Reads a CSV with the columns segment and point, x_cm and y_cm (or x_mm and y_mm) for backwards
/// and up; where there is z_cm or z_mm that is up, and y lateral. Other columns are ignored.
/// `speaker` picks the rows of one speaker where a column of that name holds several. Segments are
/// known by how their names begin, as mri_41_speakers/contours_cm.csv writes them: tongue,
/// upper_incisor_palate_velum or palate, mandible, hyoid, pharynx, epiglottis; tongue_surface is a
/// tongue's free surface alone. Others are left out. Facing and order are those of the file.
/// Throws InputError naming the file and row and what was expected.
SpeakerOutline read_outline(const std::string& path, const std::string& speaker = "");

/// The speakers that such a file holds, in its order; none where it has no column speaker.
std::vector<std::string> outline_speakers(const std::string& path);

/// Adds the palate of another file of the same form and the same origin, which takes the place of
/// the outline's own. A file without the column segment is one line, the palate.
void read_outline_palate(const std::string& path, SpeakerOutline& outline);

/// All lines of such a file, whatever their names; of a file without the column segment the one.
std::vector<std::vector<Vec2>> read_outline_lines(const std::string& path);

}  // namespace genio
