// What stands behind the handles of hearth.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/c/call.h"
#include "runtime/gpu/renderer.h"
#include "runtime/pack/pack.h"
#include "runtime/pack/pose_player.h"

#include <atomic>
#include <vector>

struct hearth_pack
{
    explicit hearth_pack(hearth::pack::Pack opened) : pack(std::move(opened)) {}

    hearth::pack::Pack pack;
    std::atomic<uint32_t> scene_count = 0; ///< of any renderer, on any thread
    std::atomic<uint32_t> player_count = 0;
    char last_error[256] = ""; ///< of hearth_pack_close

    hearth::c::MessageRoom message() { return {last_error, sizeof(last_error)}; }
};

struct hearth_player
{
    explicit hearth_player(hearth_pack& opened) : pack(opened), player(opened.pack.view()) {}

    hearth_pack& pack;
    hearth::pack::PosePlayer player;
    std::vector<hearth_move> moves; ///< as the player has them
    std::vector<hearth_pose> poses;
};

struct hearth_renderer
{
    hearth_memory_hooks memory{}; ///< the renderer below refers to them
    std::unique_ptr<hearth::gpu::Renderer> renderer;
    bool shows_overdraw = false;
    uint32_t scene_count = 0;
    uint32_t targets_count = 0;
    char last_error[512] = "";

    hearth::c::MessageRoom message() { return {last_error, sizeof(last_error)}; }
};

struct hearth_scene
{
    hearth_renderer* renderer;
    hearth_pack* pack;
    std::shared_ptr<hearth::gpu::Scene> scene; ///< the only owner

    /// The frame that was begun; of a streamed scene only.
    uint64_t serial = 0, completed_serial = 0;
    bool to_be_recorded = false;

    /// Where a frame is recorded in parts: how many of them, and with which targets.
    uint32_t parts_recorded = 0;
    const hearth_targets* parts_targets = nullptr;

    std::vector<hearth::gpu::InstanceMove> moves; ///< of the frame that is recorded; kept for its memory
    std::vector<hearth::gpu::InstancePose> poses; ///< the same
    std::vector<hearth::gpu::ShadowSphere> shadow_spheres; ///< the same
    std::vector<hearth::gpu::LightChange> lights;          ///< the same
    std::vector<hearth::gpu::EmissionScale> emissions;     ///< the same
};

struct hearth_targets
{
    hearth_renderer* renderer;
    hearth::gpu::FrameTargets targets;
    std::weak_ptr<const hearth::gpu::Scene> scene{}; ///< to which they belong, once a frame is recorded
};
