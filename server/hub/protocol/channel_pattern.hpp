#pragma once
// The patterns of channels that clients subscribe to.

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace re2 {
class RE2;
}

namespace genio {

/// A regular expression that a whole channel must match, as LCM has it; a dot stands for any byte.
/// Matching takes a time that is linear in the channel's length, whatever the pattern. A name in
/// which dots are the only signs, also with .* at its end, needs no program.
///
/// The expressions are those of RE2. It has neither references back nor looking ahead, which no
/// program can match in linear time. Classes of Unicode (\p) are refused too, since they take
/// milliseconds to compile.
class ChannelPattern {
 public:
  /// Nothing for what is no such expression, or one whose program is too large.
  static std::optional<ChannelPattern> parse(std::string_view text);

  ChannelPattern(ChannelPattern&&) noexcept;
  ChannelPattern& operator=(ChannelPattern&&) noexcept;
  ~ChannelPattern();

  const std::string& text() const { return text_; }
  bool matches(std::string_view channel) const;
  bool has_program() const { return program_ != nullptr; }
  /// What a match takes at most, in instructions of the program; 0 without a program.
  size_t cost() const;

 private:
  explicit ChannelPattern(std::string_view text);

  std::string text_;
  size_t bytes_ = 0;       // of text_, compared one by one
  bool any_tail_ = false;  // .* follows
  std::unique_ptr<re2::RE2> program_;
};

}  // namespace genio
