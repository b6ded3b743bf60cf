#include "runs/corpus/slurm.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "forward/base/text_file.hpp"
#include "forward/base/types.hpp"
#include "runs/process/program.hpp"

namespace genio {
namespace {

/// As one word of a shell.
std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// OUT/slurm/LOG in a line of #SBATCH, where % and backslashes have a meaning of their own; those
/// of `log` keep it.
std::string log_path(const SlurmJob& job, const std::string& log) {
  std::string text;
  for (const char c : job.out) {
    if (c == '%' || c == '\\') text += c;
    if (c == '"') text += '\\';
    text += c;
  }
  return fmt::format("\"{}/slurm/{}\"", text, log);
}

std::string script_head(const SlurmJob& job, const std::string& name, const std::string& log) {
  std::string text = fmt::format(
      "#!/bin/sh\n#SBATCH --job-name={}\n#SBATCH --ntasks=1\n#SBATCH --cpus-per-task=1\n"
      "#SBATCH --requeue\n#SBATCH --open-mode=append\n#SBATCH --output={}\n",
      name, log_path(job, log));
  for (const std::string& option : job.options) text += "#SBATCH " + option + "\n";
  return text;
}

void check_option(const std::string& option) {
  const std::string name = option.substr(0, option.find('='));
  if (!option.starts_with("-") || option.find('\n') != std::string::npos)
    throw InputError(
        fmt::format("--sbatch-option {}: expected an option of sbatch, as in "
                    "--sbatch-option=--partition=long",
                    option));
  for (const char* own : {"--array", "-a", "--dependency", "-d", "--wrap", "--no-requeue"})
    if (name == own)
      throw InputError(fmt::format("--sbatch-option {}: is the corpus's own", option));
}

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

/// The id of the job that a script becomes.
std::string submitted(const SlurmJob& job, std::vector<std::string> words) {
  ProgramEnd end;
  try {
    end = run_program(std::move(words));
  } catch (const InputError& e) {
    throw InputError(
        fmt::format("--slurm: {}; submit {}/slurm/tasks.sh, and merge.sh after it, where Slurm is",
                    e.what(), job.out));
  }
  const std::string line = last_line(end.said);
  std::string id = line.substr(0, line.find(';'));
  if (end.status != 0 || id.empty() || id.find_first_not_of("0123456789") != std::string::npos)
    throw InputError(fmt::format("--slurm: sbatch: {}", line));
  return id;
}

}  // namespace

std::string array_ranges(const std::vector<int>& tasks) {
  std::string text;
  for (size_t k = 0; k < tasks.size();) {
    size_t end = k + 1;
    while (end < tasks.size() && tasks[end] == tasks[end - 1] + 1) ++end;
    text += fmt::format("{}{}", text.empty() ? "" : ",", tasks[k]);
    if (end - k > 1) text += fmt::format("-{}", tasks[end - 1]);
    k = end;
  }
  return text;
}

void check_sbatch_options(const std::vector<std::string>& options) {
  for (const std::string& option : options) check_option(option);
}

void write_scripts(const SlurmJob& job) {
  make_folder(job.out + "/slurm");
  const std::string genio = shell_word(job.program) + " corpus --out " + shell_word(job.out);
  const std::string limit = job.at_once > 0 ? fmt::format("%{}", job.at_once) : "";
  write_text(job.out + "/slurm/tasks.sh",
             script_head(job, "genio", "task_%a.log") +
                 fmt::format("#SBATCH --array={}{}\n", array_ranges(job.tasks), limit) +
                 "# One task of a corpus. It goes on where it was when it was stopped.\n" + genio +
                 " --quiet --task \"$SLURM_ARRAY_TASK_ID\"\n"
                 "status=$?\n"
                 "# Killed by something else than Slurm: it is put back, three times at most.\n"
                 "if [ $status -gt 128 ] && [ \"${SLURM_RESTART_COUNT:-0}\" -lt 3 ]; then\n"
                 "  scontrol requeue \"$SLURM_JOB_ID\"\n"
                 "fi\n"
                 "exit $status\n");
  write_text(job.out + "/slurm/merge.sh",
             script_head(job, "genio-merge", "merge.log") +
                 "# Makes one of what the tasks have left; it may run at any time, and again.\n" +
                 genio + " --merge\n");
}

SubmittedJobs submit(const SlurmJob& job) {
  SubmittedJobs jobs;
  jobs.array = submitted(job, {"sbatch", "--parsable", job.out + "/slurm/tasks.sh"});
  jobs.merge = submitted(job, {"sbatch", "--parsable", "--dependency=afterany:" + jobs.array,
                               job.out + "/slurm/merge.sh"});
  return jobs;
}

}  // namespace genio
