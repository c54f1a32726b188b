// Fetches texels of any format through the first graphics device, as a shader sees them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/texel_format.h"
#include "runtime/viewer/vulkan_host.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace hearth::test
{

class TexelFetcher
{
public:
    static Result<std::unique_ptr<TexelFetcher>> create();

    /// Return true if the device samples textures of a format.
    bool supports(const formats::TexelFormatTraits& traits) const;

    /// Upload an image of one mip and fetch each of its texels.
    ///
    /// blocks  mipBytes(traits, width, height)
    /// returns  width * height texels, red, green, blue, alpha, rows from top to bottom
    Result<std::vector<std::array<float, 4>>> fetch(const formats::TexelFormatTraits& traits, uint32_t width,
                                                    uint32_t height, std::span<const std::byte> blocks);

    /// Messages of the validation layers. Must be empty.
    const std::vector<std::string>& messages() const { return host_->messages(); }

private:
    TexelFetcher() = default;

    std::unique_ptr<viewer::VulkanHost> host_;
    gpu::Device device_;
    gpu::UniqueSampler sampler_;
    gpu::UniqueSetLayout set_layout_;
    gpu::ComputePipeline pipeline_;
};

} // namespace hearth::test
