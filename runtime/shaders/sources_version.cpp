// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/shaders/sources_version.h"

namespace hearth::shaders
{

const std::string_view kSourcesVersion =
#include "sources_version.inc"
    ;

} // namespace hearth::shaders
