// Converts a file's lights for shading (C++ only), so that baked and drawn lighting agree.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/sky.h"
#include "formats/records/bricks.h"
#include "formats/records/mesh.h"
#include "formats/records/probe.h"
#include "formats/records/scene.h"
#include "formats/scene/local_probes.h"

#include <memory>
#include <span>
#include <vector>

namespace hearth::shared
{

/// Lights and sky of a scene. All light is exposed.
struct SceneLighting
{
    Sky sky;
    float exposure = 1; ///< of emission
    std::vector<Light> lights;
    std::shared_ptr<const SkyImage> sky_image{}; ///< of the sky, if it has one
    LocalProbes local_probes{};
};

/// Return the luminance of a linear colour.
float luminance(Float3 color);

/// Convert a light, before exposure, and without a shadow.
Light lightFromRecord(const formats::LightRecord& record);

/// Return the box of all instances by the boxes of their meshes, in world space, for the exposure rule. It
/// reads records that every part of a cook has, so that baked and drawn light have one exposure.
Box3 lightingBounds(std::span<const formats::InstanceRecord> instances,
                    std::span<const formats::MeshRecord> meshes);

/// Return the factor of the exposure rule for lights and emission, at most 1. The illuminance of all lights
/// together at a point in the middle of the scene is estimated. If it is more than kKeyIlluminance, all light
/// is scaled down to it, so that one camera shows lamps in candela and suns in lux. Light is never scaled up:
/// a dim light stays dim beside the sky. Beside lights emissive factors are nits, which the same factor makes
/// radiance; without lights the factor is 1, and an emissive factor is radiance, of which white paper in the
/// default sun has about 1. Lights beyond kMaxLights do not count.
///
/// bounds  lightingBounds of the scene, metres
float lightExposure(std::span<const formats::LightRecord> lights, const Box3& bounds);

/// Probes of a scene, with the texels of all.
struct SceneProbes
{
    std::span<const formats::ProbeRecord> records{};
    std::span<const uint32_t> texels{};
};

/// Return the exposed lights, the exposure, the local probes, and the sky: of its probe, or the default
/// one. A scene with neither lights nor the probe of a sky gets one sun; lights beyond kMaxLights are left
/// out.
SceneLighting sceneLighting(std::span<const formats::LightRecord> lights, const Box3& bounds,
                            const SceneProbes& probes = {});

/// Give a light the reflector of another one.
void copyReflector(Light& light, const Light& other);

/// Give lights the light of what surrounds them.
/// reflectors  of the first lights, or none
void addReflectors(SceneLighting& lighting, std::span<const formats::ReflectorRecord> reflectors);

} // namespace hearth::shared
