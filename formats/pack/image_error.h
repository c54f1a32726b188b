// Names roles of images and expresses their errors in the units of people.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"

#include <string>
#include <string_view>

namespace hearth::formats
{

/// Return the name of a role; "unknown" for a value that is none.
std::string_view imageRoleName(uint32_t role);

/// Return the name of the unit of a role's errors: "degrees", "stops", else "psnr_db".
std::string_view imageErrorUnit(ImageRole role);

/// Convert an error of ImageRecord to that unit. Infinite for a peak signal-to-noise ratio without error.
double convertImageError(ImageRole role, double error);

/// Convert an error in that unit to one of ImageRecord: the inverse of convertImageError.
double restoreImageError(ImageRole role, double converted);

/// Return the text of an error: "40.2 dB", "2.10 degrees", "0.040 stops", or "exact".
std::string imageErrorText(ImageRole role, double error);

/// Return the text of an error beside its target: "39.4 dB (target 39.0)", "37.2 dB (target 39.0, missed)". A
/// target of 0 is none.
std::string imageErrorText(ImageRole role, double error, double target);

/// Return true if no error of an image exceeds its target.
bool holdsTargets(const ImageRecord& image);

} // namespace hearth::formats
