// Reads environments: lat-long images (Radiance HDR, OpenEXR, KTX2) and cubes (KTX2).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/environment/environment.h"
#include "formats/base/result.h"

#include <cstddef>
#include <span>
#include <string>

namespace hearth::environments
{

/// Decode an environment, chosen by content. Negative radiance becomes 0: filters that ring leave it.
/// name  of the file, in messages
/// errors: image_malformed, also for values that are not finite; image_unsupported, also for an image
/// that is neither a cube nor twice as wide as high; input_too_large
Result<environment::Environment> decodeEnvironment(std::span<const std::byte> bytes, const std::string& name);

/// Read a file. errors: those of decodeEnvironment, input_missing, read_failed.
Result<environment::Environment> readEnvironment(const std::string& path);

} // namespace hearth::environments
