// Static assertions that the constants and defaults of hearth.h equal those of the runtime.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/c/handles.h"

#include <cstddef>

namespace hearth
{

namespace
{

using shared::FrameCounters;

static_assert(HEARTH_CULL_INSTANCES == shared::kCullInstances);
static_assert(HEARTH_CULL_FRUSTUM == shared::kCullFrustum);
static_assert(HEARTH_CULL_CONE == shared::kCullCone);
static_assert(HEARTH_CULL_OCCLUSION == shared::kCullOcclusion);
static_assert(HEARTH_CULL_EVERYTHING == shared::kCullEverything);

#define HEARTH_CHECK_VIEW(c_name, number, ...) static_assert(HEARTH_VIEW_##c_name == shared::number);
HEARTH_DEBUG_VIEWS(HEARTH_CHECK_VIEW)
#undef HEARTH_CHECK_VIEW

static_assert(HEARTH_AMBIENT_OCCLUSION_EXACT == shared::kAmbientOcclusionExact);
static_assert(HEARTH_AMBIENT_OCCLUSION_SMOOTHSTEP == shared::kAmbientOcclusionSmoothstep);
static_assert(HEARTH_AMBIENT_OCCLUSION_QUADRATIC == shared::kAmbientOcclusionQuadratic);
static_assert(HEARTH_AMBIENT_OCCLUSION_OFF == shared::kAmbientOcclusionOff);
static_assert(HEARTH_SPECULAR_OCCLUSION_FIT == shared::kSpecularOcclusionFit);
static_assert(HEARTH_SPECULAR_OCCLUSION_TABLE == shared::kSpecularOcclusionTable);
static_assert(HEARTH_SPECULAR_OCCLUSION_OFF == shared::kSpecularOcclusionOff);

constexpr bool equal(int c, gpu::ShadedArea area)
{
    return c == static_cast<int>(area);
}
static_assert(equal(HEARTH_SHADE_AUTOMATIC, gpu::ShadedArea::automatic));
static_assert(equal(HEARTH_SHADE_WHOLE_FRAME, gpu::ShadedArea::wholeFrame));
static_assert(equal(HEARTH_SHADE_TILES, gpu::ShadedArea::tiles));

static_assert(HEARTH_LIGHT_SUN == shared::kLightDirectional + 1);
static_assert(HEARTH_LIGHT_POINT == shared::kLightPoint + 1);
static_assert(HEARTH_LIGHT_SPOT == shared::kLightSpot + 1);

static_assert(HEARTH_LAMP_LIGHT == static_cast<int>(formats::ReceiverLampKind::light));
static_assert(HEARTH_LAMP_EMISSION == static_cast<int>(formats::ReceiverLampKind::mesh_light));

constexpr bool equal(int c, gpu::LightMethod method)
{
    return c == static_cast<int>(method);
}
static_assert(equal(HEARTH_LIGHTS_PRACTICAL, gpu::LightMethod::practical));
static_assert(equal(HEARTH_LIGHTS_ALL, gpu::LightMethod::all));
static_assert(equal(HEARTH_LIGHTS_TILED_FORWARD, gpu::LightMethod::tiled_forward));
static_assert(equal(HEARTH_LIGHTS_CLUSTERED_FORWARD, gpu::LightMethod::clustered_forward));
static_assert(equal(HEARTH_LIGHTS_FORWARD, gpu::LightMethod::forward));
static_assert(equal(HEARTH_LIGHTS_DEFERRED, gpu::LightMethod::deferred));
static_assert(equal(HEARTH_LIGHTS_TILED_DEFERRED, gpu::LightMethod::tiled_deferred));
static_assert(equal(HEARTH_LIGHTS_CLUSTERED_DEFERRED, gpu::LightMethod::clustered_deferred));
static_assert(equal(HEARTH_LIGHTS_TILE_DEFERRED, gpu::LightMethod::tile_deferred));
static_assert(equal(HEARTH_LIGHTS_STACK, gpu::LightMethod::stack));
static_assert(equal(HEARTH_LIGHTS_PREPASS, gpu::LightMethod::prepass));
static_assert(equal(HEARTH_LIGHTS_CLASSIC_PREPASS, gpu::LightMethod::classic_prepass));
static_assert(equal(HEARTH_LIGHTS_ENCODED_PREPASS, gpu::LightMethod::encoded_prepass));

constexpr bool equal(int c, gpu::LightLister lister)
{
    return c == static_cast<int>(lister);
}
static_assert(equal(HEARTH_LIGHT_LISTS_GPU, gpu::LightLister::gpu));
static_assert(equal(HEARTH_LIGHT_LISTS_CPU, gpu::LightLister::cpu));

constexpr bool equal(int c, gpu::Casters casters)
{
    return c == static_cast<int>(casters);
}
static_assert(equal(HEARTH_CASTERS_CLUSTERS, gpu::Casters::clusters));
static_assert(equal(HEARTH_CASTERS_PROXIES, gpu::Casters::proxies));

constexpr bool equal(int c, gpu::FrameTimestamp timestamp)
{
    return c == static_cast<int>(timestamp);
}
static_assert(equal(HEARTH_TIMESTAMP_BEGIN, gpu::kTimestampBegin));
static_assert(equal(HEARTH_TIMESTAMP_SHADOWS, gpu::kTimestampShadows));
static_assert(equal(HEARTH_TIMESTAMP_CULL, gpu::kTimestampCull));
static_assert(equal(HEARTH_TIMESTAMP_EARLY_VISIBILITY, gpu::kTimestampEarlyVisibility));
static_assert(equal(HEARTH_TIMESTAMP_PYRAMID, gpu::kTimestampPyramid));
static_assert(equal(HEARTH_TIMESTAMP_LATE_CULL, gpu::kTimestampLateCull));
static_assert(equal(HEARTH_TIMESTAMP_VISIBILITY, gpu::kTimestampVisibility));
static_assert(equal(HEARTH_TIMESTAMP_MATERIAL_TILES, gpu::kTimestampMaterialTiles));
static_assert(equal(HEARTH_TIMESTAMP_SHADING, gpu::kTimestampShading));
static_assert(equal(HEARTH_TIMESTAMP_COUNT, gpu::kTimestampCount));

constexpr bool equal(int c, gpu::MemoryKind kind)
{
    return c == static_cast<int>(kind);
}
static_assert(equal(HEARTH_MEMORY_DEVICE, gpu::MemoryKind::device));
static_assert(equal(HEARTH_MEMORY_STAGING, gpu::MemoryKind::staging));
static_assert(equal(HEARTH_MEMORY_READBACK, gpu::MemoryKind::readback));
static_assert(equal(HEARTH_MEMORY_TRANSIENT, gpu::MemoryKind::transient));
static_assert(equal(HEARTH_MEMORY_UPLOAD, gpu::MemoryKind::upload));

constexpr bool equal(int c, gpu::MaterialTest test)
{
    return c == static_cast<int>(test);
}
static_assert(equal(HEARTH_MATERIALS_DEPTH, gpu::MaterialTest::depth));
static_assert(equal(HEARTH_MATERIALS_ID, gpu::MaterialTest::id));

constexpr bool equal(int c, gpu::FramePart part)
{
    return c == static_cast<int>(part);
}
static_assert(equal(HEARTH_PART_CULL, gpu::FramePart::cull));
static_assert(equal(HEARTH_PART_VISIBILITY, gpu::FramePart::visibility));
static_assert(equal(HEARTH_PART_MATERIALS, gpu::FramePart::materials));

static_assert(sizeof(hearth_frame_counters) == sizeof(FrameCounters));
static_assert(offsetof(hearth_frame_counters, drawn_clusters) == offsetof(FrameCounters, drawn_clusters));
static_assert(offsetof(hearth_frame_counters, dropped_clusters) == offsetof(FrameCounters, dropped_clusters));
static_assert(offsetof(hearth_frame_counters, early_clusters) == offsetof(FrameCounters, early_clusters));

static_assert(sizeof(hearth_transform) == sizeof(Affine3d) && alignof(hearth_transform) == alignof(Affine3d));

static_assert(HEARTH_MAX_PICKS == shared::kMaxPicks);
static_assert(HEARTH_JITTER_FRAMES == gpu::kJitterFrames);
static_assert(sizeof(hearth_pick) == sizeof(shared::Pick) &&
              offsetof(hearth_pick, cluster) == offsetof(shared::Pick, cluster) &&
              offsetof(hearth_pick, triangle) == offsetof(shared::Pick, triangle));

// defaults
constexpr hearth_scene_options kSceneDefaults = HEARTH_SCENE_OPTIONS_INIT;
static_assert(kSceneDefaults.max_visible_clusters == (1u << 22) && kSceneDefaults.max_loads == 32 &&
              kSceneDefaults.frames_in_flight == 3 &&
              kSceneDefaults.skinning_bytes == gpu::DeformationOptions{}.scratch_bytes &&
              kSceneDefaults.max_lights == 128 &&
              kSceneDefaults.shadows.depth_bits == gpu::depthBits(gpu::ShadowOptions{}.depth));

} // namespace

} // namespace hearth
