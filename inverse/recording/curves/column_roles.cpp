#include "inverse/recording/curves/column_roles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace genio {
namespace {

/// What columns are usually called, in small letters. The last row's are of no use.
const std::map<std::string, std::set<std::string>> usual_titles = {
    {"x", {"x", "x_px", "x.px", "x_mm", "x.mm", "x_cm", "x.cm"}},
    {"y", {"y", "y_px", "y.px", "y_mm", "y.mm", "y_cm", "y.cm"}},
    {"frame",
     {"frame", "uniqueframe", "frame_number", "framenumber", "frame.number", "frame_no",
      "frame_num", "frame_id", "time.frame", "time_frame"}},
    {"time", {"time", "time_s", "time.s"}},
    {"label", {"label", "word", "prompt"}},
    {"likelihood", {"likelihood"}},
    {"recording", {"recording", "repetition", "rep", "token", "take", "file", "filename"}},
    {"speaker",
     {"speaker", "speaker_id", "speakerid", "spk", "talker", "subject", "subject_id", "subj",
      "participant", "participant_id"}},
    {"point", {"point", "point_number"}},
    {"", {"", "index", "unnamed: 0", "rownames"}},
};

std::string list_of(const std::vector<std::string>& titles) {
  std::string list;
  for (size_t k = 0; k < titles.size() && k < 30; ++k)
    list += (k == 0 ? "" : ", ") + in_quotes(titles[k]);
  return list;
}

/// The column of that title or number; titles.size() where there is none.
size_t column_of(const std::vector<std::string>& titles, const std::string& name) {
  for (const bool exact : {true, false})
    for (size_t c = 0; c < titles.size(); ++c) {
      const std::string title = trimmed(titles[c]);
      if (exact ? title == name : lower_case(title) == lower_case(name)) return c;
    }
  double n = 0;
  if (parse_number(name, n) && n == std::floor(n) && n >= 1 && n <= double(titles.size()))
    return size_t(n) - 1;
  return titles.size();
}

}  // namespace

ColumnRoles named_roles(const std::vector<std::string>& titles,
                        const std::map<std::string, std::string>& names, const TableLines& lines) {
  ColumnRoles roles;
  std::set<size_t> used;
  for (const auto& [role, name] : names) {
    if (role.empty() || !usual_titles.contains(role))
      throw InputError(fmt::format(
          "--columns {}={}: expected x, y, frame, time, label, likelihood, recording, speaker or "
          "point",
          role, name));
    std::vector<std::string> parts = {name};
    if (column_of(titles, name) == titles.size()) parts = split_fields(name, '+');
    for (const std::string& part : parts) {
      const size_t c = column_of(titles, part);
      if (c == titles.size())
        lines.fail(fmt::format("--columns {}={}: no column {}; the header has {}", role, name,
                               in_quotes(part), list_of(titles)));
      if (!used.insert(c).second)
        lines.fail(fmt::format("--columns {}={}: column {} is named twice", role, name,
                               in_quotes(titles[c])));
      roles.of[role].push_back(c);
    }
    if (roles.of[role].size() > 1 && role != "recording" && role != "label" && role != "speaker")
      lines.fail(fmt::format("--columns {}={}: expected one column", role, name));
  }
  for (const char* needed : {"x", "y"})
    if (!roles.has(needed))
      lines.fail(
          fmt::format("--columns names no {0}; the header has {1}. Expected "
                      "--columns x=TITLE,y=TITLE,frame=TITLE",
                      needed, list_of(titles)));
  for (size_t c = 0; c < titles.size(); ++c) {
    if (used.contains(c)) continue;
    // Whose a row is counts, said or not: one registration does not place two heads.
    const bool whose = usual_titles.at("speaker").contains(lower_case(trimmed(titles[c])));
    if (whose && !roles.has("speaker")) roles.of["speaker"].push_back(c);
    else roles.others.push_back(c);
  }
  return roles;
}

ColumnRoles guessed_roles(const std::vector<std::string>& titles, std::string& unknown) {
  ColumnRoles roles;
  for (size_t c = 0; c < titles.size(); ++c) {
    const std::string title = lower_case(trimmed(titles[c]));
    const auto role = std::find_if(usual_titles.begin(), usual_titles.end(),
                                   [&](const auto& r) { return r.second.contains(title); });
    if (role == usual_titles.end() || (roles.has(role->first) && !role->first.empty())) {
      if (unknown.empty()) unknown = title.empty() ? "''" : titles[c];
    } else if (role->first.empty()) {
      roles.others.push_back(c);
    } else {
      roles.of[role->first].push_back(c);
    }
  }
  return roles;
}

}  // namespace genio
