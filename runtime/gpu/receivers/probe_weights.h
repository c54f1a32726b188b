// Weights of local probes: a probe shows its room under the lamps as they were baked. The light of each
// lamp on the faces of bricks around it says how its brightness and colour follow them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"
#include "formats/pack/pack_view.h"
#include "formats/scene/local_probes.h"

#include <vector>

namespace hearth::gpu
{

class ProbeWeights
{
public:
    /// Sum the light of each lamp over the faces in the box of each probe, by their solid angles. A probe
    /// without such faces, as all in packs whose bricks have no receivers, keeps its light.
    /// pack    checked
    /// probes  that are drawn
    ProbeWeights(const formats::PackView& pack, const shared::LocalProbes& probes);

    bool isEmpty() const { return light_.empty(); }

    /// Return the light of a probe's surroundings under weights of the lamps, over that under weights of 1.
    /// A channel without light stays as it is.
    Float3 weigh(size_t probe, std::span<const Float3> weights) const;

private:
    size_t lamp_count_ = 0;
    std::vector<Double3> light_; ///< [probes][lamps]: sums of radiance; empty if no probe follows lamps
};

} // namespace hearth::gpu
