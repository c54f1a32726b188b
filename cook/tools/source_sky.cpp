// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/source_sky.h"

#include "cook/tools/source_name.h"
#include "formats/scene/sky_image.h"

#include <cstring>

namespace hearth::tools
{

using formats::PackView;
using formats::ProbeRecord;

namespace
{

bool haveSameProbe(const PackView& a, const PackView& b)
{
    return a.probes().size_bytes() == b.probes().size_bytes() &&
           a.probeTexels().size_bytes() == b.probeTexels().size_bytes() &&
           std::memcmp(a.probes().data(), b.probes().data(), a.probes().size_bytes()) == 0 &&
           std::memcmp(a.probeTexels().data(), b.probeTexels().data(), a.probeTexels().size_bytes()) == 0;
}

} // namespace

Result<const PackView*> findSourceSky(std::span<const PackView* const> import_parts)
{
    const PackView* found = nullptr;
    for (const PackView* const part : import_parts)
    {
        if (!shared::findSkyProbe(part->probes()))
            continue;
        if (found == nullptr)
            found = part;
        else if (!haveSameProbe(*found, *part))
            return Error{Issue::profile_value, readSourceName(*part), "import.sky",
                         "its image-based light is not that of " + readSourceName(*found) +
                             ", and a pack has one sky: set import.sky to off in the rule of one of them, or "
                             "name an image of the sky with --sky"};
    }
    return found;
}

} // namespace hearth::tools
