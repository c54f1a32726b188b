// Weights that the window gives the lamps of a pack: of its lights, and of instances whose light is baked.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/receivers/lamp_names.h"
#include "runtime/viewer/lamp_options.h"

#include <vector>

namespace hearth::viewer
{

/// Lamp of the panel. Its weight is brightness times colour.
struct LampControl
{
    pack::NamedLamp lamp;
    float brightness = 1;
    Float3 color{1, 1, 1};

    Float3 weight() const { return color * brightness; }
};

/// List the lamps of a pack under the weights of the options.
/// errors: usage if the pack has no lamp of a name.
Result<std::vector<LampControl>> listLampControls(const formats::PackView& pack,
                                                  std::span<const LampSetting> options);

/// Weights that one scene has, until a frame changes them.
class SceneLampWeights
{
public:
    /// Find the weights that differ from the scene's. Lights that it does not draw are left out.
    /// errors: same as gpu::weighLight.
    Status update(std::span<const LampControl> lamps, const gpu::Scene& scene);

    /// Weights that the next frame sets; valid until the next update.
    std::span<const gpu::LampWeight> changes() const { return changes_; }

private:
    std::vector<Float3> weights_; ///< of the lamps, as the scene has them; 1 behind the end
    std::vector<gpu::LampWeight> changes_;
};

} // namespace hearth::viewer
