#pragma once
// What MeasuredOptions say of the files of a session.

#include "inverse/recording/session/session.hpp"
#include "runs/frames/measured.hpp"

namespace genio {

/// How the target is read. Throws InputError naming the option.
ReadOptions read_options_of(const MeasuredOptions& o);

/// What is read of the files beside the target as it is of the target.
ReadOptions beside(ReadOptions read);

/// The target, unless an option is given that it has no use for. Throws InputError naming file,
/// field or option.
SessionFile target_of(const MeasuredOptions& o, const ReadOptions& read);

/// The palate that the options name; none where they name none. Throws as target_of().
std::optional<SessionFile> palate_of(const MeasuredOptions& o, const ReadOptions& read,
                                     const SessionFile& target);

/// Which way the target's axes point, as far as its format and the caller say. Throws InputError
/// naming the option that would say it.
AxesReading said_axes(const SessionFile& target, const ReadOptions& read);

}  // namespace genio
