// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/scene_sky.h"

#include "cook/tools/open_part.h"
#include "cook/tools/source_sky.h"

namespace hearth::bricks
{

Result<SceneSky> SceneSky::open(const StaticScene& scene, const std::string& probe)
{
    SceneSky sky;
    if (!probe.empty())
    {
        HEARTH_ASSIGN_OR_RETURN(sky.part_, tools::openPart(probe));
        return sky;
    }
    std::vector<const formats::PackView*> parts;
    for (const SourceParts& source : scene.sources)
        parts.push_back(&source.scene);
    HEARTH_ASSIGN_OR_RETURN(sky.source_, tools::findSourceSky(parts));
    return sky;
}

shared::SceneProbes SceneSky::probes() const
{
    const formats::PackView* const view = part_ ? &*part_ : source_;
    return view == nullptr ? shared::SceneProbes{} : shared::SceneProbes{view->probes(), view->probeTexels()};
}

} // namespace hearth::bricks
