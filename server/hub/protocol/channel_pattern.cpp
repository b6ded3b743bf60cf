#include "server/hub/protocol/channel_pattern.hpp"

#include <re2/re2.h>

#include <algorithm>

namespace genio {
namespace {

// A program and the states that matching it keeps; of the hardest patterns 20 kB were measured.
constexpr int64_t max_memory = 32 << 10;
constexpr int max_program = 300, min_cost = 32;

RE2::Options pattern_options() {
  RE2::Options options;
  options.set_log_errors(false);
  options.set_max_mem(max_memory);
  options.set_encoding(RE2::Options::EncodingLatin1);  // a channel is bytes
  options.set_dot_nl(true);
  options.set_never_capture(true);
  return options;
}

bool names_unicode_class(std::string_view text) {
  for (size_t i = 0; i + 1 < text.size(); ++i) {
    if (text[i] != '\\') continue;
    ++i;  // what is escaped
    if (text[i] == 'p' || text[i] == 'P') return true;
  }
  return false;
}

}  // namespace

ChannelPattern::ChannelPattern(std::string_view text) : text_(text), bytes_(text.size()) {}
ChannelPattern::ChannelPattern(ChannelPattern&&) noexcept = default;
ChannelPattern& ChannelPattern::operator=(ChannelPattern&&) noexcept = default;
ChannelPattern::~ChannelPattern() = default;

std::optional<ChannelPattern> ChannelPattern::parse(std::string_view text) {
  ChannelPattern pattern(text);
  if (text.ends_with(".*")) pattern.any_tail_ = true, pattern.bytes_ -= 2;
  if (text.substr(0, pattern.bytes_).find_first_of("\\^$|()[]{}*+?") == text.npos) return pattern;
  if (names_unicode_class(text)) return std::nullopt;
  pattern.program_ = std::make_unique<RE2>(re2::StringPiece(text.data(), text.size()),  //
                                           pattern_options());
  if (!pattern.program_->ok() || pattern.program_->ProgramSize() > max_program) return std::nullopt;
  return pattern;
}

bool ChannelPattern::matches(std::string_view channel) const {
  if (program_)
    return program_->Match(re2::StringPiece(channel.data(), channel.size()), 0, channel.size(),
                           RE2::ANCHOR_BOTH, nullptr, 0);
  if (any_tail_ ? channel.size() < bytes_ : channel.size() != bytes_) return false;
  return std::equal(text_.begin(), text_.begin() + std::ptrdiff_t(bytes_), channel.begin(),
                    [](char wanted, char c) { return wanted == c || wanted == '.'; });
}

size_t ChannelPattern::cost() const {
  return program_ ? size_t(std::max(min_cost, program_->ProgramSize())) : 0;
}

}  // namespace genio
