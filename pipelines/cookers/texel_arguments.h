// Arguments of the cookers that read a textures part for the target.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cookers/cooker.h"

namespace hearth::cookers
{

/// Key of the bytes that the textures of a pack may take.
inline constexpr std::string_view kTextureBudget = "textures.budget";

/// Convert settings of textures into words; as Cooker::makeArguments.
Result<Arguments> makeTexelArguments(const settings::Values& values);

} // namespace hearth::cookers
