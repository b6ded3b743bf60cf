#include "speaker/volume/label_volume.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "forward/base/input_file.hpp"

namespace genio {
namespace {

constexpr size_t most_labels = 1000, shown_labels = 20;
constexpr double most_in_box = 256 << 20;  // voxels
constexpr double largest_label = 1e15;
constexpr double whole = 1e-3;  // a scaled value may be off a whole number by so much
constexpr int rim = 2;          // voxels

/// A file that is compressed, or not.
class PackedFile {
 public:
  explicit PackedFile(const std::string& path) : path_(path) {
    check_input(path);
    file_.reset(gzopen(path.c_str(), "rb"));
    if (!file_) throw InputError(path + ": cannot be opened");
    gzbuffer(file_.get(), 1 << 17);
  }
  /// The next bytes; fewer at the file's end.
  size_t read(char* to, size_t bytes) {
    const int got = gzread(file_.get(), to, unsigned(bytes));
    if (got < 0) throw InputError(path_ + ": is damaged; expected a whole gzip file");
    return size_t(got);
  }

 private:
  struct Close {
    void operator()(gzFile file) const { gzclose(file); }
  };
  std::string path_;
  std::unique_ptr<gzFile_s, Close> file_;
};

struct LabelExtent {
  std::int64_t voxels = 0;
  std::array<int, 3> low{}, high{};
};

/// act(j, k, labels of a row along i) for each row of the volume.
NiftiHeader each_row(const std::string& path,
                     const std::function<void(int, int, const std::vector<std::int64_t>&)>& act) {
  PackedFile file(path);
  std::string bytes(NiftiHeader::bytes, '\0');
  bytes.resize(file.read(bytes.data(), bytes.size()));
  const NiftiHeader header = read_nifti_header(bytes, path);
  for (std::uint64_t at = NiftiHeader::bytes; at < header.offset;) {  // extensions
    char skipped[4096];
    const size_t got =
        file.read(skipped, size_t(std::min<std::uint64_t>(sizeof skipped, header.offset - at)));
    if (got == 0) throw InputError(path + ": field vox_offset: lies behind the file's end");
    at += got;
  }
  const size_t n = size_t(header.size[0]);
  std::vector<char> raw(n * header.voxel_bytes);
  std::vector<std::int64_t> labels(n);
  for (int k = 0; k < header.size[2]; ++k)
    for (int j = 0; j < header.size[1]; ++j) {
      if (file.read(raw.data(), raw.size()) < raw.size())
        throw InputError(fmt::format("{}: ends in slice {} of {}; field dim tells of more voxels",
                                     path, k + 1, header.size[2]));
      for (size_t i = 0; i < n; ++i) {
        const double value =
            header.slope * nifti_value(header, &raw[i * header.voxel_bytes]) + header.intercept;
        // Not "greater": a NaN is no label either.
        if (!(std::abs(value) < largest_label) || std::abs(value - std::round(value)) > whole)
          throw InputError(fmt::format("{}: voxel {},{},{}: {} is no label; expected whole numbers",
                                       path, i, j, k, value));
        labels[i] = std::int64_t(std::llround(value));
      }
      act(j, k, labels);
    }
  return header;
}

std::string list_of(const std::map<std::int64_t, LabelExtent>& labels) {
  std::string text;
  size_t count = 0;
  for (const auto& [label, extent] : labels) {
    if (label == 0) continue;
    if (count++ == shown_labels) return text + ", ...";
    text += fmt::format("{}{}", text.empty() ? "" : ", ", label);
  }
  return text;
}

std::int64_t chosen_label(const std::string& path,
                          const std::map<std::int64_t, LabelExtent>& labels,
                          std::optional<std::int64_t> asked) {
  const std::string list = list_of(labels);
  if (list.empty()) throw InputError(path + ": every voxel is 0; expected a label");
  if (asked == 0) throw InputError(path + ": label 0 is what has no label; expected another");
  if (asked) {
    if (!labels.contains(*asked))
      throw InputError(
          fmt::format("{}: no voxel has the label {}; there are {}", path, *asked, list));
    return *asked;
  }
  if (labels.size() - labels.count(0) > 1)
    throw InputError(
        fmt::format("{}: has the labels {}; expected --label with one of them", path, list));
  return labels.begin()->first != 0 ? labels.begin()->first : labels.rbegin()->first;
}

}  // namespace

LabelledBox read_labelled_box(const std::string& path, std::optional<std::int64_t> label) {
  std::map<std::int64_t, LabelExtent> labels;
  const NiftiHeader header =
      each_row(path, [&](int j, int k, const std::vector<std::int64_t>& row) {
        for (size_t first = 0, last; first < row.size(); first = last) {
          for (last = first + 1; last < row.size() && row[last] == row[first];) ++last;
          const std::array<int, 3> low = {int(first), j, k}, high = {int(last) - 1, j, k};
          const auto [it, fresh] = labels.try_emplace(row[first], LabelExtent{0, low, high});
          if (fresh && labels.size() > most_labels)
            throw InputError(
                fmt::format("{}: has more than {} values; expected labels, not an "
                            "image",
                            path, most_labels));
          LabelExtent& extent = it->second;
          extent.voxels += std::int64_t(last - first);
          for (size_t d = 0; d < 3; ++d) {
            extent.low[d] = std::min(extent.low[d], low[d]);
            extent.high[d] = std::max(extent.high[d], high[d]);
          }
        }
      });
  LabelledBox box{};
  box.label = chosen_label(path, labels, label);
  const LabelExtent& extent = labels.at(box.label);
  box.voxels = extent.voxels;
  double in_box = 1;
  Vec3 corner;
  for (size_t d = 0; d < 3; ++d) {
    box.size[d] = extent.high[d] - extent.low[d] + 1 + 2 * rim;
    corner[Eigen::Index(d)] = extent.low[d] - rim;
    in_box *= box.size[d];
  }
  if (in_box > most_in_box)
    throw InputError(fmt::format("{}: label {} spans {:.3g} voxels; expected at most {:.3g}", path,
                                 box.label, in_box, most_in_box));
  box.to_metres = header.to_metres * Eigen::Translation3d(corner);
  box.is.assign(size_t(in_box), 0);
  each_row(path, [&](int j, int k, const std::vector<std::int64_t>& row) {
    if (j < extent.low[1] || j > extent.high[1] || k < extent.low[2] || k > extent.high[2]) return;
    const size_t start =
        (size_t(k - extent.low[2] + rim) * size_t(box.size[1]) + size_t(j - extent.low[1] + rim)) *
            size_t(box.size[0]) +
        rim;
    for (int i = extent.low[0]; i <= extent.high[0]; ++i)
      box.is[start + size_t(i - extent.low[0])] = row[size_t(i)] == box.label;
  });
  return box;
}

}  // namespace genio
