// Flames, sparks and smoke of the fire: a pass of the game's own behind Hearth's frame, on its images.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "gpu.h"
#include "vec.h"

#include <vector>

namespace game
{

class Particles
{
public:
    Particles(Gpu& gpu, const hearth_targets_info& images);

    /// Go on by some seconds.
    void step(float seconds);
    /// Draw them over a frame with this camera. Leaves the colour to copies: TRANSFER_SRC_OPTIMAL.
    void record(VkCommandBuffer commands, const hearth_camera& camera);

private:
    enum Kind : uint32_t
    {
        kFlame,
        kSpark,
        kSmoke
    };
    struct Particle
    {
        Kind kind;
        Vec position, velocity;
        float age, life; ///< seconds
    };
    struct Instance
    {
        Vec center;
        float size;
        float color[4];
    };
    void createPass();
    void createPipeline();
    void emit(Kind kind);
    float random() { return static_cast<float>((seed_ = seed_ * 1664525u + 1013904223u) >> 8) / 16777216.0f; }
    static Instance draw(const Particle& particle);

    Gpu& gpu_;
    hearth_targets_info images_;
    VkRenderPass pass_ = VK_NULL_HANDLE;
    VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
    std::vector<Buffer> instances_; ///< by slot
    std::vector<Particle> particles_;
    uint32_t seed_ = 1;
    float due_ = 0; ///< of the next particle, seconds
};

} // namespace game
