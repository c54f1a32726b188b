// Objects behind the handles of hearth.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/c/call.h"
#include "runtime/gpu/passes/pick_pass.h"
#include "runtime/gpu/renderer.h"
#include "runtime/gpu/temporal/motion_pass.h"
#include "runtime/gpu/temporal/temporal_pass.h"
#include "runtime/pack/light_player.h"
#include "runtime/pack/pack.h"
#include "runtime/pack/pose_player.h"
#include "runtime/pack/queries/scene_queries.h"

#include <atomic>
#include <vector>

struct hearth_pack
{
    explicit hearth_pack(hearth::pack::Pack opened) : pack(std::move(opened)) {}

    hearth::pack::Pack pack;
    std::atomic<uint32_t> scene_count = 0; ///< of any renderer, on any thread
    std::atomic<uint32_t> player_count = 0;
    std::atomic<uint32_t> queries_count = 0;
    char last_error[256] = ""; ///< of hearth_pack_close

    hearth::c::MessageBuffer message() { return {last_error, sizeof(last_error)}; }
};

struct hearth_player
{
    explicit hearth_player(hearth_pack& opened)
        : pack(opened), player(opened.pack.view()), light_player(opened.pack.view())
    {
    }

    hearth_pack& pack;
    hearth::pack::PosePlayer player;
    hearth::pack::LightPlayer light_player;
    std::vector<hearth_move> moves; ///< same moves as the player's, converted
    std::vector<hearth_pose> poses;
    std::vector<hearth_light_change> changed_lights; ///< same as the light player's, converted
    std::vector<hearth_light_change> lights;
};

struct hearth_queries
{
    hearth_queries(hearth_pack& opened, uint64_t page_bytes)
        : pack(opened), queries(opened.pack.view(), page_bytes)
    {
    }

    hearth_pack& pack;
    hearth::pack::SceneQueries queries;
};

struct hearth_renderer
{
    hearth_memory_hooks memory{}; ///< the renderer below refers to them, and to the next one
    hearth::gpu::MaterialShaders material_shaders;
    std::unique_ptr<hearth::gpu::Renderer> renderer;
    std::optional<hearth::gpu::TemporalPass> temporal; ///< once targets ask for it
    bool shows_overdraw = false;
    uint32_t scene_count = 0;
    uint32_t targets_count = 0;
    char last_error[512] = "";

    hearth::c::MessageBuffer message() { return {last_error, sizeof(last_error)}; }
};

struct hearth_scene
{
    hearth_renderer* renderer;
    hearth_pack* pack;
    std::shared_ptr<hearth::gpu::Scene> scene; ///< the only owner

    uint32_t prepared_lights = 1u << HEARTH_LIGHTS_PRACTICAL; ///< bit i: light method i
    std::optional<hearth::gpu::PickPass> picks;               ///< once they are prepared
    std::optional<hearth::gpu::MotionPass> motion;            ///< with HEARTH_SCENE_MOTION

    /// Frame that was begun; streamed scenes only.
    uint64_t serial = 0, completed_serial = 0;
    bool to_be_recorded = false;

    /// Number of parts recorded so far of a frame that is recorded in parts, and its targets.
    uint32_t parts_recorded = 0;
    const hearth_targets* parts_targets = nullptr;

    /// of the frame that is recorded; a member to reuse its memory
    std::vector<hearth::gpu::InstanceMove> moves;
    std::vector<hearth::gpu::InstancePose> poses;          ///< as moves
    std::vector<hearth::gpu::ShadowSphere> shadow_spheres; ///< as moves
    std::vector<hearth::gpu::LightChange> lights;          ///< as moves
    std::vector<hearth::gpu::LampWeight> lamp_weights;     ///< as moves
    std::optional<hearth::gpu::DaylightChange> daylight;   ///< as moves
    std::vector<hearth::gpu::EmissionScale> emissions;     ///< as moves
};

namespace hearth::c
{

gpu::OcclusionCulling toOcclusion(uint32_t occlusion); ///< HEARTH_OCCLUSION_*

} // namespace hearth::c

struct hearth_targets
{
    hearth_renderer* renderer;
    hearth::gpu::FrameTargets targets;
    /// scene that the targets belong to, once a frame is recorded
    std::weak_ptr<const hearth::gpu::Scene> scene{};
    uint64_t motion_frame = 0; ///< frame that motion vectors were recorded for last; 0: none
};
