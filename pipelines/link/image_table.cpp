// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/link/image_table.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <tuple>

namespace hearth::link
{

using namespace formats;

namespace
{

/// Return the bytes of a record, without those of its name.
std::string recordKey(const ImageRecord& image)
{
    const auto* const bytes = reinterpret_cast<const char*>(&image);
    return std::string(bytes, sizeof(image)).substr(sizeof(image.name));
}

bool isSameData(const PackView& a, const ChunkEntry& of_a, const PackView& b, const ChunkEntry& of_b)
{
    return of_a.codec == of_b.codec && of_a.size == of_b.size &&
           std::ranges::equal(a.container().stored(of_a), b.container().stored(of_b));
}

} // namespace

ImageTable::ImageTable(std::span<const PackView* const> parts)
{
    // Images with equal records and sizes, by number in the pack; their bytes are compared then.
    std::map<std::pair<std::string, uint64_t>, std::vector<uint32_t>> similar;
    for (uint32_t source = 0; source < parts.size(); ++source)
        for (uint32_t image = 0; image < parts[source]->images().size(); ++image)
        {
            const ChunkEntry* const data = parts[source]->container().find(kChunkImageData, image);
            const auto next = static_cast<uint32_t>(places_.size());
            if (data == nullptr) // the check of the pack reports it
            {
                images_.push_back(next);
                places_.push_back({source, image});
                continue;
            }
            std::vector<uint32_t>& candidates =
                similar[{recordKey(parts[source]->images()[image]), data->stored_size}];
            const auto isEqual = [&](uint32_t candidate)
            {
                const ImagePlace& place = places_[candidate];
                const PackView& part = *parts[place.source];
                return isSameData(part, *part.container().find(kChunkImageData, place.image), *parts[source],
                                  *data);
            };
            const auto found = std::ranges::find_if(candidates, isEqual);
            images_.push_back(found == candidates.end() ? next : *found);
            if (found != candidates.end())
                continue;
            candidates.push_back(next);
            places_.push_back({source, image});
        }
}

} // namespace hearth::link
