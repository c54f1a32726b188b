// What a user asks of clips: the table [animation] of a profile. See cook/animation_compression/README.md, "Profiles".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_compression/fitted_clip.h"
#include "formats/base/result.h"

#include <string>
#include <string_view>

namespace hearth::clips
{

/// The key animation.error of a profile: metres, from 0, which keeps clips as they are. Without it the default: a share of
/// the size of each model. Strict, as the cluster builder is with its own table.
/// errors: input_missing, profile_syntax, profile_key, profile_value; they name the line and the key.
Result<StatedError> readStatedError(const std::string& profile_path);

/// The same of TOML text; `name` is what messages call it.
/// errors: profile_syntax, profile_key, profile_value.
Result<StatedError> parseStatedError(std::string_view text, const std::string& name);

} // namespace hearth::clips
