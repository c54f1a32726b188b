// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/texture_files/exr_writer.h"

#include "formats/base/assert.h"

#include <string_view>

namespace hearth::texture_files
{

namespace
{

/// Appends values to a file, in the byte order of the machine: formats are little-endian throughout the
/// project.
class Bytes
{
public:
    template <typename T>
    void add(const T& value)
    {
        const auto* const from = reinterpret_cast<const std::byte*>(&value);
        bytes_.insert(bytes_.end(), from, from + sizeof(value));
    }

    /// Add a text with a final zero.
    void addText(std::string_view text)
    {
        const auto* const from = reinterpret_cast<const std::byte*>(text.data());
        bytes_.insert(bytes_.end(), from, from + text.size());
        bytes_.push_back(std::byte{0});
    }

    template <typename... T>
    void addAttribute(std::string_view name, std::string_view type, const T&... values)
    {
        addText(name);
        addText(type);
        add(static_cast<uint32_t>((sizeof(values) + ...)));
        (add(values), ...);
    }

    size_t size() const { return bytes_.size(); }
    std::vector<std::byte> take() { return std::move(bytes_); }

private:
    std::vector<std::byte> bytes_;
};

constexpr uint32_t kExrMagic = 20000630, kExrVersion = 2;
constexpr uint32_t kExrFloat = 2;

// Channels in the order of their names, as the format asks, and their places in a Float3.
constexpr std::string_view kChannels = "BGR";
constexpr int kChannelOfColor[] = {2, 1, 0};

void addHeader(Bytes& file, uint32_t width, uint32_t height)
{
    file.add(kExrMagic);
    file.add(kExrVersion);
    file.addText("channels");
    file.addText("chlist");
    constexpr uint32_t kChannelBytes = 18; // name, type, linearity, sampling
    file.add(static_cast<uint32_t>(kChannels.size() * kChannelBytes + 1));
    for (const char name : kChannels)
    {
        file.addText(std::string_view(&name, 1));
        for (const uint32_t value : {kExrFloat, 0u, 1u, 1u})
            file.add(value);
    }
    file.add(uint8_t{0}); // ends the list
    file.addAttribute("compression", "compression", uint8_t{0});
    for (const std::string_view window : {"dataWindow", "displayWindow"})
        file.addAttribute(window, "box2i", uint32_t{0}, uint32_t{0}, width - 1, height - 1);
    file.addAttribute("lineOrder", "lineOrder", uint8_t{0});
    file.addAttribute("pixelAspectRatio", "float", 1.0f);
    file.addAttribute("screenWindowCenter", "v2f", 0.0f, 0.0f);
    file.addAttribute("screenWindowWidth", "float", 1.0f);
    file.add(uint8_t{0}); // ends the header
}

} // namespace

std::vector<std::byte> writeExr(uint32_t width, uint32_t height, std::span<const Float3> texels)
{
    HEARTH_ASSERT(width > 0 && height > 0 && texels.size() == size_t{width} * height);
    Bytes file;
    addHeader(file, width, height);
    const uint64_t row_bytes = kChannels.size() * sizeof(float) * width;
    const uint64_t first_row = file.size() + sizeof(uint64_t) * height;
    for (uint32_t y = 0; y < height; ++y)
        file.add(first_row + y * (row_bytes + 2 * sizeof(uint32_t)));
    for (uint32_t y = 0; y < height; ++y)
    {
        file.add(y);
        file.add(static_cast<uint32_t>(row_bytes));
        for (const int channel : kChannelOfColor)
            for (const Float3& texel : texels.subspan(size_t{y} * width, width))
                file.add(texel[channel]);
    }
    return file.take();
}

} // namespace hearth::texture_files
