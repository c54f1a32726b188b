// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/images/read_oiio.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <optional>

namespace hearth::images
{

namespace
{

// Channels that are read at once, at most: those of a layer lie together.
constexpr int kMaxChannels = 16;
// Parts of an EXR that are looked at, at most.
constexpr int kMaxParts = 256;

// Values of the tag PhotometricInterpretation; TIFF 6.0, section 8, and its supplements.
constexpr int kTiffWhiteIsZero = 0, kTiffBlackIsZero = 1, kTiffSeparated = 5;

const char* readerName(Format format)
{
    switch (format)
    {
    case Format::exr:
        return "openexr";
    case Format::jpeg2000:
        return "jpeg2000";
    default:
        return "tiff";
    }
}

const char* formatName(Format format)
{
    switch (format)
    {
    case Format::exr:
        return "EXR";
    case Format::jpeg2000:
        return "JPEG 2000";
    default:
        return "TIFF";
    }
}

/// File in memory that OpenImageIO reads.
class OpenFile
{
public:
    OpenFile(Format format, std::span<const std::byte> bytes)
        : format_(format), stream_(const_cast<std::byte*>(bytes.data()), bytes.size())
    {
    }

    /// keeps_ink  CMYK is not converted to RGB
    Status open(bool keeps_ink)
    {
        OIIO::ImageSpec config, spec;
        OIIO::Filesystem::IOProxy* stream = &stream_;
        config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &stream);
        config.attribute("oiio:UnassociatedAlpha", 1);
        config.attribute("oiio:RawColor", keeps_ink ? 1 : 0);
        stream_.seek(0);
        input_ = OIIO::ImageInput::create(readerName(format_));
        if (!input_ || !input_->open("image", spec, config))
            return failure();
        return success();
    }

    OIIO::ImageInput& input() { return *input_; }

    Error error(Issue issue, const std::string& detail) const
    {
        return {issue, "", "", std::string(formatName(format_)) + ": " + detail};
    }

    /// Return the error that OpenImageIO reports.
    Error failure() const
    {
        const std::string text = input_ ? input_->geterror() : "";
        return error(Issue::image_malformed, text.empty() ? "the file cannot be read" : text);
    }

private:
    Format format_;
    OIIO::Filesystem::IOMemReader stream_;
    std::unique_ptr<OIIO::ImageInput> input_;
};

/// Part of a file and the channels of its image.
struct Choice
{
    int part = 0;
    uint32_t color_count = 0;
    std::array<int, 4> colors{};
    int alpha = -1; ///< channel; negative: none
};

std::optional<int> findChannel(const OIIO::ImageSpec& spec, const std::string& name)
{
    const auto found = std::find(spec.channelnames.begin(), spec.channelnames.end(), name);
    if (found == spec.channelnames.end())
        return std::nullopt;
    return static_cast<int>(found - spec.channelnames.begin());
}

/// Return the channels R, G, B, A or Y, A after `prefix`; nullopt: there are none.
std::optional<Choice> findLayer(const OIIO::ImageSpec& spec, int part, const std::string& prefix)
{
    Choice choice{.part = part};
    for (const char* name : {"R", "G", "B"})
        if (const auto channel = findChannel(spec, prefix + name))
            choice.colors[choice.color_count++] = *channel;
    const auto grey = findChannel(spec, prefix + "Y");
    if (choice.color_count != 3 && !grey)
        return std::nullopt;
    if (choice.color_count != 3)
    {
        choice.color_count = 1;
        choice.colors[0] = *grey;
    }
    choice.alpha = findChannel(spec, prefix + "A").value_or(-1);
    return choice;
}

/// Add the layers of a part to `names`: its own name, and "part.diffuse" for channels "diffuse.R".
void addLayerNames(const OIIO::ImageSpec& spec, int part, std::vector<std::string>& names)
{
    std::vector<std::string> layers;
    const std::string own = spec.get_string_attribute("oiio:subimagename");
    layers.push_back(own.empty() ? "part " + std::to_string(part) : own);
    for (const std::string& channel : spec.channelnames)
        if (const size_t dot = channel.rfind('.'); dot != channel.npos)
            layers.push_back(channel.substr(0, dot));
    for (const std::string& layer : layers)
        if (std::find(names.begin(), names.end(), layer) == names.end())
            names.push_back(layer);
}

/// Return "diffuse, specular, Z and 4 more".
std::string joinNames(const std::vector<std::string>& names)
{
    constexpr size_t kMaxNames = 8;
    std::string text;
    for (size_t i = 0; i < std::min(names.size(), kMaxNames); ++i)
        text += (i == 0 ? "" : ", ") + names[i].substr(0, 40);
    return names.size() <= kMaxNames ? text
                                     : text + " and " + std::to_string(names.size() - kMaxNames) + " more";
}

/// Choose the part and the channels of an EXR.
Result<Choice> chooseLayer(OpenFile& file, std::string_view layer, Samples& samples)
{
    std::optional<Choice> named, first;
    std::string first_name;
    std::vector<std::string> names;
    for (int part = 0; part < kMaxParts && file.input().seek_subimage(part, 0); ++part)
    {
        const OIIO::ImageSpec spec = file.input().spec();
        const std::string own = spec.get_string_attribute("oiio:subimagename");
        addLayerNames(spec, part, names);
        if (spec.deep)
            continue;
        if (!named && !layer.empty())
            named =
                own == layer ? findLayer(spec, part, "") : findLayer(spec, part, std::string(layer) + ".");
        if (!first)
        {
            first = findLayer(spec, part, "");
            first_name = own.empty() ? "part " + std::to_string(part) : own;
        }
    }
    // asking for a part behind the last one is no error of the file
    file.input().geterror();
    if (!named && !first)
        return file.error(Issue::image_unsupported, "none of its parts has channels R, G and B, or Y, of one "
                                                    "depth a texel: " +
                                                        joinNames(names));
    const std::string taken = named ? std::string(layer) : first_name;
    if (!named && !layer.empty())
        samples.addNote(Issue::image_layers,
                        "it has no layer '" + std::string(layer) + "', but " + joinNames(names));
    std::erase(names, taken);
    if (!names.empty())
        samples.addNote(Issue::image_layers,
                        "layers beside '" + taken + "' are not kept: " + joinNames(names));
    return named ? *named : *first;
}

/// Choose the channels of a TIFF or a JPEG 2000 image, whose colours come first.
Result<Choice> chooseColors(OpenFile& file, bool is_ink, Samples& samples)
{
    const OIIO::ImageSpec& spec = file.input().spec();
    const int photometric = spec.get_int_attribute("tiff:PhotometricInterpretation", -1);
    const bool is_grey =
        spec.nchannels < 3 || photometric == kTiffWhiteIsZero || photometric == kTiffBlackIsZero;
    Choice choice{.color_count = is_ink ? 4u : is_grey ? 1u : 3u, .colors = {0, 1, 2, 3}};
    const auto color_count = static_cast<int>(choice.color_count);
    if (spec.nchannels < color_count)
        return file.error(Issue::image_malformed, "channels are missing");
    // OpenImageIO knows no alpha beside ink
    choice.alpha = is_ink || spec.alpha_channel < color_count ? -1 : spec.alpha_channel;
    const int others = spec.nchannels - color_count - (choice.alpha >= 0 ? 1 : 0);
    if (others > 0)
        samples.addNote(Issue::image_layers,
                        "channels beside the image are not kept: " + std::to_string(others));
    return choice;
}

/// Choose the numbers to read: as the file has them, or the nearest that can hold them.
Result<Number> chooseNumber(const OpenFile& file, const OIIO::ImageSpec& spec, bool is_exr, Samples& samples)
{
    switch (spec.format.basetype)
    {
    case OIIO::TypeDesc::UINT8:
        return Number::unorm8;
    case OIIO::TypeDesc::UINT16:
        return Number::unorm16;
    case OIIO::TypeDesc::HALF:
        return Number::float32;
    case OIIO::TypeDesc::FLOAT:
    case OIIO::TypeDesc::DOUBLE:
        samples.addNote(Issue::image_depth, "its channels have " + std::to_string(8 * spec.format.size()) +
                                                " bits, 16 are kept, as floats");
        return Number::float32;
    case OIIO::TypeDesc::UINT32:
        if (is_exr)
            break;
        samples.addNote(Issue::image_depth, "its channels have 32 bits, 16 are kept");
        return Number::unorm16;
    default:
        break;
    }
    return file.error(Issue::image_unsupported,
                      std::string("channels of type ") + spec.format.c_str() + " are not read");
}

OIIO::TypeDesc typeOfNumber(Number number)
{
    return number == Number::unorm8    ? OIIO::TypeDesc::UINT8
           : number == Number::unorm16 ? OIIO::TypeDesc::UINT16
                                       : OIIO::TypeDesc::FLOAT;
}

/// Read the chosen channels.
Status readValues(OpenFile& file, const Choice& choice, Samples& samples)
{
    const auto* const colors = choice.colors.data();
    int first = *std::min_element(colors, colors + choice.color_count);
    int last = *std::max_element(colors, colors + choice.color_count);
    if (choice.alpha >= 0)
    {
        first = std::min(first, choice.alpha);
        last = std::max(last, choice.alpha);
    }
    if (last - first >= kMaxChannels)
        return file.error(Issue::image_unsupported, "its channels lie too far apart");
    samples.color_count = choice.color_count;
    samples.channel_count = static_cast<uint32_t>(last - first + 1);
    for (size_t c = 0; c < choice.color_count; ++c)
        samples.colors[c] = static_cast<uint32_t>(choice.colors[c] - first);
    samples.alpha_channel = static_cast<uint32_t>(std::max(choice.alpha - first, 0));
    samples.values.resize(size_t{samples.width} * samples.height * samples.channel_count *
                          numberBytes(samples.number));
    return file.input().read_image(choice.part, 0, first, last + 1, typeOfNumber(samples.number),
                                   samples.values.data())
               ? success()
               : Status(file.failure());
}

void readProfile(const OIIO::ImageSpec& spec, Samples& samples)
{
    const OIIO::ParamValue* profile = spec.find_attribute("ICCProfile");
    if (profile == nullptr || profile->type().basetype != OIIO::TypeDesc::UINT8)
        return;
    const auto* bytes = static_cast<const std::byte*>(profile->data());
    samples.profile.assign(bytes, bytes + profile->type().size());
}

} // namespace

void prepareReaders()
{
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    for (const Format format : {Format::tiff, Format::exr, Format::jpeg2000})
        OIIO::ImageInput::create(readerName(format));
}

Result<Samples> readByOiio(const Request& request, std::string_view layer, std::span<const std::byte> bytes)
{
    Samples samples;
    OpenFile file(request.format, bytes);
    HEARTH_TRY(file.open(false));
    const bool is_exr = request.format == Format::exr;
    const bool is_ink =
        file.input().spec().get_int_attribute("tiff:PhotometricInterpretation", -1) == kTiffSeparated;
    if (is_ink)
        HEARTH_TRY(file.open(true));
    HEARTH_ASSIGN_OR_RETURN(const Choice choice,
                            is_exr ? chooseLayer(file, layer, samples) : chooseColors(file, is_ink, samples));
    const OIIO::ImageSpec spec = file.input().spec(choice.part, 0);
    HEARTH_TRY(checkSize(request, static_cast<uint64_t>(std::max(spec.width, 0)),
                         static_cast<uint64_t>(std::max(spec.height, 0))));
    if (spec.deep || spec.depth > 1)
        return file.error(Issue::image_unsupported, "deep images and volumes are not read");
    samples.width = static_cast<uint32_t>(spec.width);
    samples.height = static_cast<uint32_t>(spec.height);
    HEARTH_ASSIGN_OR_RETURN(samples.number, chooseNumber(file, spec, is_exr, samples));
    // an EXR keeps the colours that it has, as one that hearth-import reads itself
    const bool is_straight = is_exr || request.format == Format::jpeg2000 ||
                             spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0;
    if (choice.alpha >= 0)
        samples.alpha = is_straight ? Alpha::straight : Alpha::multiplied;
    if (request.format == Format::tiff)
        samples.orientation = static_cast<uint32_t>(spec.get_int_attribute("Orientation", 1));
    readProfile(spec, samples);
    HEARTH_TRY(readValues(file, choice, samples));
    return samples;
}

} // namespace hearth::images
