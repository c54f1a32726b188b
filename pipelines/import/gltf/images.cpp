// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/images.h"

#include "pipelines/import/images/channels.h"
#include "pipelines/import/images/decode.h"
#include "pipelines/import/part/part_builder.h"
#include "pipelines/import/source/file_bytes.h"

#include "pipelines/import/gltf/document/uri.h"
#include "pipelines/import/images/placeholder.h"

#include <fmt/format.h>

#include <set>

namespace hearth::import
{

using namespace formats;

namespace
{

constexpr std::array<uint8_t, 4> kWhite{255, 255, 255, 255};
constexpr std::array<uint8_t, 4> kFlatNormal{128, 128, 255, 255};

/// Return a conspicuous placeholder for a colour, and a neutral value for data and normals, so that only one
/// property of the surface looks wrong.
DecodedImage placeholder(ImagePurpose purpose)
{
    DecodedImage image = makePlaceholderImage();
    if (purpose == ImagePurpose::color)
        return image;
    const auto& texel = purpose == ImagePurpose::normal ? kFlatNormal : kWhite;
    for (size_t i = 0; i < image.texels.size(); ++i)
        image.texels[i] = std::byte{texel[i % 4]};
    return image;
}

ImageRecord recordFor(ImagePurpose purpose)
{
    ImageRecord record{};
    record.format = static_cast<uint32_t>(purpose == ImagePurpose::color ? TexelFormat::rgba8_srgb
                                                                         : TexelFormat::rgba8_unorm);
    record.flags = purpose == ImagePurpose::normal ? kImageNormalMap : 0u;
    return record;
}

} // namespace

std::string GltfImages::imageName(uint32_t image) const
{
    if (image == kInvalidIndex)
        return "missing";
    const GltfImage& source = model_.images[image];
    if (!source.name.empty())
        return source.name;
    if (source.uri && !isDataUri(*source.uri))
        return source.uri->substr(source.uri->rfind('/') + 1);
    return fmt::format("image {}", image);
}

Result<DecodedImage> GltfImages::read(uint32_t image, const std::string& where) const
{
    if (image == kInvalidIndex)
        return context_.error(Issue::input_missing, where, "the texture has no image");
    const GltfImage& source = model_.images[image];
    if (source.uri)
    {
        HEARTH_ASSIGN_OR_RETURN(const FileBytes file, readUri(*source.uri, where, context_));
        return decodeImage(file.bytes(), imageName(image), context_.options.limits,
                           context_.options.artist.withoutIcc());
    }
    if (source.buffer_view == kInvalidIndex)
        return context_.error(Issue::input_missing, where, "the image has neither a URI nor a buffer view");
    return decodeImage(buffers_.view(source.buffer_view), imageName(image), context_.options.limits,
                       context_.options.artist.withoutIcc());
}

std::optional<DecodedImage> GltfImages::decode(uint32_t image, const std::string& where,
                                               const std::string& user)
{
    const bool first_time = requested_.emplace(image, true).second;
    Result<DecodedImage> read_image = read(image, where);
    if (read_image.ok())
    {
        for (const ImageNote& note : read_image->notes)
            if (first_time)
                context_.part.warn(note.issue, where,
                                   fmt::format("image \"{}\" of {}: {}", imageName(image), user, note.text));
        return std::move(read_image).value();
    }
    const Error& error = read_image.error();
    const bool missing = error.issue == Issue::input_missing;
    const bool has_uri = image != kInvalidIndex && model_.images[image].uri.has_value();
    context_.part.warn(
        missing ? Issue::image_missing : Issue::image_replaced, where,
        fmt::format("image \"{}\" of {}: {}", imageName(image), user,
                    error.detail.empty() ? issueInfo(error.issue).summary : std::string_view(error.detail)),
        has_uri ? suggestNearestForUri(*model_.images[image].uri, error.issue, context_) : "");
    return std::nullopt;
}

void GltfImages::warnOfUse(const DecodedImage& image, ImagePurpose purpose, const std::string& where,
                           const std::string& name)
{
    const bool are_colors = purpose == ImagePurpose::color;
    if (are_colors)
        context_.part.warnOfColorDepth(image, where, name);
    context_.part.warnOfTransfer(image, are_colors, where, name);
}

Result<uint32_t> GltfImages::write(uint32_t image, ImagePurpose purpose, const std::string& where,
                                   const std::string& user)
{
    const auto found = written_.find({image, purpose});
    if (found != written_.end())
        return found->second;
    const std::string image_where = image == kInvalidIndex ? where : fmt::format("/images/{}", image);
    std::optional<DecodedImage> decoded = decode(image, image_where, user);
    ImageRecord record = recordFor(purpose);
    record.name = context_.part.intern(imageName(image));
    if (!decoded)
        record.flags |= kImagePlaceholder;
    else
        warnOfUse(*decoded, purpose, image_where, fmt::format("image \"{}\" of {}", imageName(image), user));
    if (decoded && purpose == ImagePurpose::normal)
        decoded = completeNormals(*std::move(decoded));
    const auto cutoff = alpha_cutoff_of_image_.find(image);
    if (purpose == ImagePurpose::color && cutoff != alpha_cutoff_of_image_.end())
    {
        record.flags |= kImageAlphaTested;
        record.alpha_cutoff = cutoff->second;
    }
    HEARTH_ASSIGN_OR_RETURN(const uint32_t index,
                            context_.part.addImage(record, decoded ? *decoded : placeholder(purpose)));
    written_.emplace(std::pair(image, purpose), index);
    return index;
}

Result<uint32_t> GltfImages::writeComputed(const DecodedImage& image, ImagePurpose purpose,
                                           const std::string& name, std::optional<float> alpha_cutoff)
{
    ImageRecord record = recordFor(purpose);
    record.name = context_.part.intern(name);
    if (alpha_cutoff)
    {
        record.flags |= kImageAlphaTested;
        record.alpha_cutoff = *alpha_cutoff;
    }
    return context_.part.addImage(record, image);
}

void GltfImages::reportUnused() const
{
    std::set<uint32_t> faces;
    for (const GltfImageLight& light : model_.image_lights)
        for (const std::vector<uint32_t>& mip : light.faces_of_mip)
            faces.insert(mip.begin(), mip.end());
    for (uint32_t image = 0; image < model_.images.size(); ++image)
        if (!requested_.contains(image) && !faces.contains(image))
            context_.part.warn(
                Issue::dropped, fmt::format("/images/{}", image),
                fmt::format("image \"{}\", which no material uses, is not kept", imageName(image)));
}

} // namespace hearth::import
