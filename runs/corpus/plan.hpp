#pragma once
// Which frames of a corpus are answered by which task.

#include <string>
#include <vector>

namespace genio {

/// A recording of a corpus, once it was read and laid beside the model.
struct PlannedRecording {
  std::string name;                ///< of its folder
  std::string file, speaker;       ///< as the manifest has them
  int line = 0;                    ///< of the manifest
  std::vector<std::string> words;  ///< of `genio invert`
  std::string model;               ///< path: recordings of one model follow one another
  std::string question;            ///< what every answer depends on, as JSON
  double noise = 0;                ///< [m]
  std::vector<int> frames;         ///< their numbers
  bool whole = false;              ///< its frames hang together, so that one task takes all
  std::string refused;             ///< why it gives no frames; empty: it gives some
};

/// Neighbouring frames of one recording: places in `frames`, from `first` to before `end`.
struct Piece {
  int recording = 0;
  int first = 0, end = 0;
};
using Task = std::vector<Piece>;

struct Plan {
  std::string folder;  ///< that the paths of the words start from
  int share = 0;       ///< frames a task
  std::vector<PlannedRecording> recordings;
  std::vector<Task> tasks;
};

/// How many frames a task takes where nobody says: some minute's work, so that starting it counts
/// little, and at most 1000 tasks. It depends on no machine.
int usual_share(int frames);

/// Cuts the frames of all recordings into tasks of about `share` frames. Each frame is in exactly
/// one; recordings of one model follow one another.
std::vector<Task> cut(const std::vector<PlannedRecording>& recordings, int share);

int frames_of(const Task& task);

/// DIR/plan.json. Reading throws InputError where it is missing or damaged.
void write_plan(const Plan& plan, const std::string& out);
Plan read_plan(const std::string& out);

/// DIR/tasks/0003, and the folder in it of a recording's lines.
std::string task_folder(const std::string& out, int task);
std::string lines_folder(const std::string& out, int task, const PlannedRecording& recording);

}  // namespace genio
