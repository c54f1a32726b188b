// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/report/light_images.h"

#include "formats/pack/pack_check.h"
#include "pipelines/light_pictures/probe_picture.h"
#include "pipelines/light_pictures/receiver_picture.h"

#include <algorithm>
#include <fmt/format.h>
#include <numbers>

namespace hearth::report
{

using formats::ProbeRecord;

namespace
{

/// Texels of an edge of the largest faces that are shown, six beside each other.
constexpr uint32_t kMaxFaceSide = 64;

/// Columns of the largest atlas that is shown as it is.
constexpr uint32_t kMaxAtlasWidth = 640;

std::string toPng(const light_pictures::LightPicture& picture, double factor)
{
    const std::vector<std::byte> png = light_pictures::encodePng(picture, factor);
    return {reinterpret_cast<const char*>(png.data()), png.size()};
}

std::string formatPoint(Float3 point)
{
    return fmt::format("{:.4g}, {:.4g}, {:.4g}", point.x, point.y, point.z);
}

LightImage drawProbe(const formats::PackView& pack, size_t number)
{
    const ProbeRecord& record = pack.probes()[number];
    const light_pictures::ProbeMips mips = light_pictures::decodeMips(pack, record);
    size_t first = 0;
    while (first + 1 < mips.mips.size() && mips.side(first) > kMaxFaceSide)
        ++first;
    LightImage image{.name =
                         (record.flags & formats::kProbeIsSky) != 0 ? "sky" : fmt::format("probe {}", number),
                     .png = toPng(light_pictures::drawProbe(mips, first), std::numbers::pi),
                     .facts = {}};
    image.facts.emplace_back("faces",
                             fmt::format("{0} × {0} texels, {1} mips", mips.side(0), mips.mips.size()));
    image.facts.emplace_back("mean irradiance", formatPoint(record.irradiance));
    if (formats::isLocalProbe(record))
    {
        image.facts.emplace_back("position", formatPoint(record.position));
        image.facts.emplace_back("box", formatPoint(record.box_min) + " to " + formatPoint(record.box_max));
    }
    return image;
}

LightImage drawAtlas(const formats::PackView& pack)
{
    const formats::ReceiverTables tables = pack.receivers();
    const light_pictures::LightPicture picture = light_pictures::drawReceivers(tables, true);
    const uint32_t factor = (picture.width + kMaxAtlasWidth - 1) / kMaxAtlasWidth;
    return {.name = "receivers",
            .png = toPng(light_pictures::shrink(picture, std::max(factor, 1u)), 1),
            .facts = {{"atlas", fmt::format("{} × {} texels", picture.width, picture.height)},
                      {"lamps", std::to_string(tables.lamps.size())},
                      {"red", "texels without a lamp of more than 2 % of their light"}}};
}

} // namespace

std::vector<LightImage> drawLight(const formats::PackView& pack)
{
    std::vector<LightImage> images;
    for (size_t i = 0; i < std::min(pack.probes().size(), kMaxProbeImages); ++i)
        images.push_back(drawProbe(pack, i));
    if (!pack.receiverAtlases().empty())
        images.push_back(drawAtlas(pack));
    return images;
}

std::vector<LightImage> drawLightOfPack(const std::string& path)
{
    auto reader = formats::ContainerReader::open(path, formats::Check::structure);
    if (!reader.ok())
        return {};
    const auto pack = formats::PackView::read(std::move(reader).value());
    return pack.ok() && formats::checkTables(*pack).ok() ? drawLight(*pack) : std::vector<LightImage>{};
}

} // namespace hearth::report
