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

/// Return the bytes of a record without its name and its targets: images that rules hold to several targets
/// may have the same texels.
std::string recordKey(ImageRecord image)
{
    image.target = image.target_smooth = 0;
    const auto* const bytes = reinterpret_cast<const char*>(&image);
    return std::string(bytes, sizeof(image)).substr(sizeof(image.name));
}

/// Return the stricter of two targets, of which 0 is none.
float findStricter(float a, float b)
{
    return a == 0 || b == 0 ? std::max(a, b) : std::min(a, b);
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
            const ImageRecord& record = parts[source]->images()[image];
            const ImagePlace own{source, image, record.target, record.target_smooth};
            const ChunkEntry* const data = parts[source]->container().find(kChunkImageData, image);
            const auto next = static_cast<uint32_t>(places_.size());
            if (data == nullptr) // the check of the pack reports it
            {
                images_.push_back(next);
                places_.push_back(own);
                continue;
            }
            std::vector<uint32_t>& candidates = similar[{recordKey(record), data->stored_size}];
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
            {
                ImagePlace& place = places_[*found];
                place.target = findStricter(place.target, own.target);
                place.target_smooth = findStricter(place.target_smooth, own.target_smooth);
                continue;
            }
            candidates.push_back(next);
            places_.push_back(own);
        }
}

} // namespace hearth::link
