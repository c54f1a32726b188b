// Reads the settings of animation compression: table [animation] of a profile. See
// cook/animation_compression/README.md, "Profiles".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_compression/fitted_clip.h"
#include "formats/base/result.h"

#include <string>
#include <string_view>

namespace hearth::animation_compression
{

/// Read the key animation.error of a profile: metres, from 0, which keeps clips unchanged. Without the key
/// the default is a share of the size of each model. Unknown keys are errors, as in the cluster builder's
/// table.
/// errors: input_missing, profile_syntax, profile_key, profile_value; they name the line and the key.
Result<StatedError> readStatedError(const std::string& profile_path);

/// Read the same key from TOML text. `name` is the file's name in messages.
/// errors: profile_syntax, profile_key, profile_value.
Result<StatedError> parseStatedError(std::string_view text, const std::string& name);

} // namespace hearth::animation_compression
