#pragma once
// The few calls of HDF5 that tables need. Not for other rooms.

#include <hdf5.h>

#include <string>
#include <utility>
#include <vector>

namespace genio {

/// An identifier that is closed when it is no longer needed. Throws InputError "PATH: WHAT" where
/// the library gave none.
class HdfId {
 public:
  HdfId(hid_t id, herr_t (*close)(hid_t), const std::string& where);
  HdfId(HdfId&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  HdfId(const HdfId&) = delete;
  HdfId& operator=(const HdfId&) = delete;
  ~HdfId() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// An array of at most two dimensions; one of one dimension is a column.
struct HdfNumbers {
  size_t rows = 0, columns = 0;
  std::vector<double> values;  ///< row after row
};

bool hdf_has(hid_t place, const std::string& name);
bool hdf_has_attribute(hid_t object, const std::string& name);

/// Those of a dataset below `place`. All throw InputError naming it and beginning with `path`.
HdfNumbers hdf_numbers(hid_t place, const std::string& name, const std::string& path);
std::vector<std::string> hdf_texts(hid_t place, const std::string& name, const std::string& path);
/// True where the dataset holds texts.
bool hdf_is_text(hid_t place, const std::string& name, const std::string& path);

std::string hdf_text_attribute(hid_t object, const std::string& name, const std::string& path);
/// `absent` where there is no such attribute.
double hdf_number_attribute(hid_t object, const std::string& name, double absent);

/// One field of a table of records: its numbers, a row a record, or its texts.
HdfNumbers hdf_field_numbers(hid_t table, const std::string& field, const std::string& path);
std::vector<std::string> hdf_field_texts(hid_t table, const std::string& field,
                                         const std::string& path);
bool hdf_field_is_text(hid_t table, const std::string& field, const std::string& path);
std::vector<std::string> hdf_fields(hid_t table, const std::string& path);

}  // namespace genio
