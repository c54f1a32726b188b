// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/texture_graph.h"

#include <limits>

namespace hearth::pack
{

TextureGraph::TextureGraph(std::span<const std::vector<uint64_t>> sizes) : nodes_(makeNodes(sizes))
{
    for (uint32_t image = 0; image < sizes.size(); ++image)
    {
        const auto count = static_cast<uint32_t>(sizes[image].size());
        first_nodes_.push_back(static_cast<uint32_t>(mips_.size()));
        mip_counts_.push_back(count);
        for (uint32_t mip = count; mip-- > 0;)
            mips_.push_back({image, mip});
    }
}

std::vector<PageNode> TextureGraph::makeNodes(std::span<const std::vector<uint64_t>> sizes)
{
    std::vector<PageNode> nodes;
    for (const std::vector<uint64_t>& image : sizes)
        for (size_t mip = image.size(); mip-- > 0;)
        {
            HEARTH_ASSERT(image[mip] <= std::numeric_limits<uint32_t>::max());
            PageNode node;
            node.size_bytes = static_cast<uint32_t>(image[mip]);
            if (mip + 1 == image.size())
                node.holds_root = true;
            else
                node.needs.push_back(static_cast<uint32_t>(nodes.size()) - 1);
            nodes.push_back(std::move(node));
        }
    return nodes;
}

} // namespace hearth::pack
