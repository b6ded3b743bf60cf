#pragma once
// A disk that remembers what was written and what was flushed, to lose its power afterwards; and
// that fails when it is told to.

#include <sqlite3.h>

#include <cstring>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace genio::test {

/// While it lives, what SQLite does to files is recorded; one at a time in a process.
class RecordedDisk {
 public:
  struct Event {
    enum Kind { write, truncate, flush } kind;
    std::string file;
    size_t at = 0;  ///< offset, or length
    std::string bytes;
  };

  RecordedDisk() {
    recording() = this;
    base() = sqlite3_vfs_find(nullptr);
    vfs_ = *base();
    vfs_.zName = "recorded", vfs_.szOsFile = int(sizeof(File)) + base()->szOsFile;
    vfs_.xOpen = open;
    sqlite3_vfs_register(&vfs_, 1);
  }
  ~RecordedDisk() {
    sqlite3_vfs_unregister(&vfs_);
    sqlite3_vfs_register(base(), 1);
    recording() = nullptr;
  }
  RecordedDisk(const RecordedDisk&) = delete;
  RecordedDisk& operator=(const RecordedDisk&) = delete;

  std::vector<Event> events;
  /// Gives what a call is to end with instead of being made: SQLITE_OK lets it be made.
  enum class Call { read, write, flush };
  std::function<int(Call)> fault;

 private:
  struct File {
    sqlite3_file as_sqlite;
    std::string* name;
    sqlite3_io_methods methods;
    sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
  };
  static RecordedDisk*& recording() {
    static RecordedDisk* disk = nullptr;
    return disk;
  }
  static sqlite3_vfs*& base() {
    static sqlite3_vfs* vfs = nullptr;
    return vfs;
  }
  static File* of(sqlite3_file* file) { return reinterpret_cast<File*>(file); }
  static void record(sqlite3_file* file, Event::Kind kind, sqlite3_int64 at = 0,
                     std::string bytes = {}) {
    if (recording())
      recording()->events.push_back({kind, *of(file)->name, size_t(at), std::move(bytes)});
  }

  static int fault_of(Call call) {
    const RecordedDisk* disk = recording();
    return disk && disk->fault ? disk->fault(call) : SQLITE_OK;
  }

  static int open(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* out) {
    File* f = of(file);
    const int code = base()->xOpen(base(), name, f->real(), flags, out);
    file->pMethods = nullptr;
    if (code != SQLITE_OK) return code;
    f->name = new std::string(name ? name : "");
    sqlite3_io_methods m{};
    m.iVersion = 2;
    m.xClose = [](sqlite3_file* x) {
      delete of(x)->name;
      return of(x)->real()->pMethods->xClose(of(x)->real());
    };
    m.xRead = [](sqlite3_file* x, void* to, int n, sqlite3_int64 at) {
      if (const int failed = fault_of(Call::read)) return failed;
      return of(x)->real()->pMethods->xRead(of(x)->real(), to, n, at);
    };
    m.xWrite = [](sqlite3_file* x, const void* from, int n, sqlite3_int64 at) {
      if (const int failed = fault_of(Call::write)) return failed;
      record(x, Event::write, at, {static_cast<const char*>(from), size_t(n)});
      return of(x)->real()->pMethods->xWrite(of(x)->real(), from, n, at);
    };
    m.xTruncate = [](sqlite3_file* x, sqlite3_int64 size) {
      record(x, Event::truncate, size);
      return of(x)->real()->pMethods->xTruncate(of(x)->real(), size);
    };
    m.xSync = [](sqlite3_file* x, int how) {
      if (const int failed = fault_of(Call::flush)) return failed;
      record(x, Event::flush);
      return of(x)->real()->pMethods->xSync(of(x)->real(), how);
    };
    m.xFileSize = [](sqlite3_file* x, sqlite3_int64* size) {
      return of(x)->real()->pMethods->xFileSize(of(x)->real(), size);
    };
    m.xLock = [](sqlite3_file* x, int how) {
      return of(x)->real()->pMethods->xLock(of(x)->real(), how);
    };
    m.xUnlock = [](sqlite3_file* x, int how) {
      return of(x)->real()->pMethods->xUnlock(of(x)->real(), how);
    };
    m.xCheckReservedLock = [](sqlite3_file* x, int* held) {
      return of(x)->real()->pMethods->xCheckReservedLock(of(x)->real(), held);
    };
    m.xFileControl = [](sqlite3_file* x, int what, void* with) {
      return of(x)->real()->pMethods->xFileControl(of(x)->real(), what, with);
    };
    m.xSectorSize = [](sqlite3_file* x) {
      return of(x)->real()->pMethods->xSectorSize(of(x)->real());
    };
    m.xDeviceCharacteristics = [](sqlite3_file* x) {
      return of(x)->real()->pMethods->xDeviceCharacteristics(of(x)->real());
    };
    m.xShmMap = [](sqlite3_file* x, int page, int size, int extend, void volatile** to) {
      return of(x)->real()->pMethods->xShmMap(of(x)->real(), page, size, extend, to);
    };
    m.xShmLock = [](sqlite3_file* x, int at, int n, int how) {
      return of(x)->real()->pMethods->xShmLock(of(x)->real(), at, n, how);
    };
    m.xShmBarrier = [](sqlite3_file* x) { of(x)->real()->pMethods->xShmBarrier(of(x)->real()); };
    m.xShmUnmap = [](sqlite3_file* x, int remove) {
      return of(x)->real()->pMethods->xShmUnmap(of(x)->real(), remove);
    };
    f->methods = m;
    file->pMethods = &f->methods;
    return SQLITE_OK;
  }

  sqlite3_vfs vfs_{};
};

/// What is on a disk that is written to, and what it would hold without power from one moment on:
/// all that was flushed, and of the rest any sectors.
class FailingDisk {
 public:
  explicit FailingDisk(std::map<std::string, std::string> files) : flushed_(std::move(files)) {}

  void happens(const RecordedDisk::Event& event) {
    auto& waiting = waiting_[event.file];
    if (event.kind != RecordedDisk::Event::flush) return waiting.push_back(event);
    for (const auto& e : waiting) apply(e, flushed_[event.file]);
    waiting.clear();
  }

  std::map<std::string, std::string> without_power(std::mt19937& random) const {
    auto files = flushed_;
    for (const auto& [file, waiting] : waiting_)
      for (const auto& event : waiting) {
        const auto fate = random() % 4;
        if (fate == 0) continue;
        if (fate == 1 || event.kind == RecordedDisk::Event::truncate) {
          apply(event, files[file]);
          continue;
        }
        constexpr size_t sector = 512;
        for (size_t at = 0; at < event.bytes.size(); at += sector)
          if (random() % 2)
            apply({event.kind, file, event.at + at, event.bytes.substr(at, sector)}, files[file]);
      }
    return files;
  }

 private:
  static void apply(const RecordedDisk::Event& event, std::string& file) {
    if (event.kind == RecordedDisk::Event::truncate) return file.resize(event.at);
    if (file.size() < event.at + event.bytes.size()) file.resize(event.at + event.bytes.size());
    std::memcpy(file.data() + event.at, event.bytes.data(), event.bytes.size());
  }

  std::map<std::string, std::string> flushed_;
  std::map<std::string, std::vector<RecordedDisk::Event>> waiting_;
};

}  // namespace genio::test
