// Mips of a pack's images as nodes of a graph, for streaming. See runtime/pack/README.md, "Textures".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/page_graph.h"

#include <span>
#include <vector>

namespace hearth::pack
{

/// Mip of an image, down to the first of the tail, which stands for the whole tail.
struct TextureMip
{
    uint32_t image;
    uint32_t mip;
    friend bool operator==(const TextureMip&, const TextureMip&) = default;
};

/// Nodes of the mips: each needs the next coarser one, and the tails are pinned.
///
/// A device has an image with some mips, and brings a finer one by another image, into which it copies them.
/// A node takes the bytes of a whole image from its mip on, so that the two images, which exist side by side
/// for a while, never take more than the nodes that are resident or loading. Images that rest take three
/// quarters of that.
class TextureGraph
{
public:
    /// sizes  [image][mip] bytes on the device of an image that begins with that mip, for each mip down to
    ///        the first of the tail; empty: the image is not streamed
    explicit TextureGraph(std::span<const std::vector<uint64_t>> sizes);

    const PageGraph& nodes() const { return nodes_; }
    uint32_t mipCount(uint32_t image) const { return mip_counts_[image]; } ///< 0: not streamed
    uint32_t node(const TextureMip& mip) const
    {
        return first_nodes_[mip.image] + lastMip(mip.image) - mip.mip;
    }
    const TextureMip& mip(uint32_t node) const { return mips_[node]; }

private:
    uint32_t lastMip(uint32_t image) const { return mip_counts_[image] - 1; }
    static std::vector<PageNode> makeNodes(std::span<const std::vector<uint64_t>> sizes);

    PageGraph nodes_;
    std::vector<uint32_t> first_nodes_, mip_counts_; ///< by image; the first node is the tail
    std::vector<TextureMip> mips_;                   ///< by node
};

} // namespace hearth::pack
