#include "inverse/recording/binary/pickled_text.hpp"

#include <fmt/format.h>

#include <map>

#include "inverse/recording/base/table_text.hpp"

namespace genio {
namespace {

/// What the pickle machine's stack holds: a text, or the texts of a tuple, or a list of tuples.
struct Pickled {
  enum class Kind { mark, text, tuple, list } kind = Kind::mark;
  std::string text = {};
  std::vector<std::string> tuple = {};
  std::vector<std::vector<std::string>> list = {};
};

class PickleMachine {
 public:
  PickleMachine(const std::string& bytes, const std::string& where)
      : bytes_(bytes), where_(where) {}

  std::vector<std::vector<std::string>> run() {
    while (at_ < bytes_.size()) {
      const char code = bytes_[at_++];
      if (code == '.') {
        if (stack_.size() != 1 || stack_.back().kind != Pickled::Kind::list) refuse(code);
        return std::move(stack_.back().list);
      }
      step(code);
    }
    refuse('?');
  }

 private:
  using Kind = Pickled::Kind;
  [[noreturn]] void refuse(char code) const {
    throw InputError(
        fmt::format("{}: titles of columns are no list of tuples of texts ({} at byte "
                    "{}); give DeepLabCut's CSV instead",
                    where_, in_quotes(std::string(1, code)), at_));
  }
  std::string line() {
    const size_t end = bytes_.find('\n', at_);
    if (end == std::string::npos) refuse('?');
    const std::string text = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return text;
  }
  Pickled pop(Kind kind) {
    if (stack_.empty() || stack_.back().kind != kind) refuse('?');
    Pickled top = std::move(stack_.back());
    stack_.pop_back();
    return top;
  }
  /// The texts down to the last mark.
  std::vector<std::string> tuple() {
    std::vector<std::string> texts;
    while (!stack_.empty() && stack_.back().kind == Kind::text)
      texts.insert(texts.begin(), pop(Kind::text).text);
    pop(Kind::mark);
    return texts;
  }
  void append() {
    Pickled item = pop(Kind::tuple);
    if (stack_.empty() || stack_.back().kind != Kind::list) refuse('a');
    stack_.back().list.push_back(std::move(item.tuple));
  }
  void step(char code) {
    switch (code) {
      case '(':
        stack_.push_back({});
        return;
      case 'V':
        stack_.push_back({Kind::text, line()});
        return;
      case 't':
        stack_.push_back({Kind::tuple, {}, tuple()});
        return;
      case 'a':
        append();
        return;
      case 'l':
        pop(Kind::mark);
        stack_.push_back({Kind::list});
        return;
      case 'p':
        if (stack_.empty()) refuse(code);
        if (stack_.back().kind != Kind::list) memo_[line()] = stack_.back();
        else line();
        return;
      case 'g': {
        const auto known = memo_.find(line());
        if (known == memo_.end()) refuse(code);
        stack_.push_back(known->second);
        return;
      }
      default:
        refuse(code);
    }
  }

  const std::string& bytes_;
  const std::string& where_;
  size_t at_ = 0;
  std::vector<Pickled> stack_;
  std::map<std::string, Pickled> memo_;
};

}  // namespace

std::vector<std::vector<std::string>> pickled_titles(const std::string& pickled,
                                                     const std::string& where) {
  return PickleMachine(pickled, where).run();
}

}  // namespace genio
