#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace genio {

/// A request that waits for its turn.
struct WaitingRequest {
  std::string id;
  int priority = 0;
  std::string stream = {};  ///< requests of one stream run one after another; empty: of none
  size_t bytes = 0;
  std::string client = {};
  /// Its place among equals, which next() gives. Until then it has none.
  struct Place {
    int64_t round = 0, number = -1;
  } place = {};
};

/// Who comes next: the highest priority, then one request of each client in turn, then the first
/// that came. Requests of one stream keep their order, whatever their priorities, and one whose
/// forerunner runs lets others pass.
class WaitingLine {
 public:
  /// The id must be new. What was taken out by next() gets its place back.
  void add(WaitingRequest request);
  /// Takes one out; false where it does not wait.
  bool remove(const std::string& id);
  /// Takes out who is next. `busy`: streams of which a request runs.
  std::optional<WaitingRequest> next(const std::set<std::string>& busy);

  size_t size() const { return by_turn_.size(); }
  /// How many of that client wait.
  size_t size_of(const std::string& client) const;
  size_t bytes() const { return bytes_; }
  /// In the order of their turns.
  std::vector<std::string> ids() const;

 private:
  using Turn = std::tuple<int, int64_t, int64_t>;  // minus the priority, round, number
  /// What waits of a client, and the last of its rounds.
  struct Share {
    size_t count = 0;
    int64_t round = 0;
  };
  void remove(std::map<Turn, WaitingRequest>::iterator at);

  std::map<Turn, WaitingRequest> by_turn_;
  std::map<std::string, Turn> turns_;                 // by id
  std::map<std::string, std::set<int64_t>> streams_;  // numbers that wait
  std::map<std::string, Share> clients_;
  int64_t number_ = 0, round_ = 0;  // round_: of who was taken out last
  size_t bytes_ = 0;
};

}  // namespace genio
