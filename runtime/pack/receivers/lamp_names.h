// Finds the lamps of a pack that a game can weigh, by the names that its source gives them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <string>
#include <string_view>
#include <vector>

namespace hearth::pack
{

/// Light of a pack, or an instance that emits and is a lamp of the pack's receivers.
struct NamedLamp
{
    std::string_view
        name; ///< of the light, or of the instance's node; of the pack. May be empty, or not unique
    formats::ReceiverLampKind kind = formats::ReceiverLampKind::light;
    uint32_t index = 0; ///< of chunk LGHT or INST
};

/// List the lamps of a pack: all of its lights, then instances.
std::vector<NamedLamp> listLamps(const formats::PackView& pack);

/// Return the lamps with a name, one at least.
/// errors: usage, with the names that there are.
Result<std::vector<NamedLamp>> findLamps(const formats::PackView& pack, std::string_view name);

} // namespace hearth::pack
