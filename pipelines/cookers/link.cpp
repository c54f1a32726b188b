// hearth-link: from parts to a pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/words.h"

namespace hearth::cookers
{

Cooker describeLink()
{
    return {.name = "link", .scope = settings::Scope::pack, .cost = {16 * kMiB, 3, 0.01}};
}

} // namespace hearth::cookers
