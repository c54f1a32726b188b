// Pictures of frames as PNG files.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "gpu.h"

namespace game
{

/// Reads an image back and writes it to files.
class Picture
{
public:
    Picture(Gpu& gpu, uint32_t width, uint32_t height);
    /// Record a copy of an image of this size that is in TRANSFER_SRC_OPTIMAL, ready for transfers.
    void record(VkCommandBuffer commands, VkImage image);
    /// Write the copy, once its commands have run.
    void write(const std::string& path) const;

private:
    uint32_t width_, height_;
    Buffer buffer_;
};

} // namespace game
