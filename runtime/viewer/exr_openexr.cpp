// Implementation of OpenEXR encoding; the only file of the viewer that includes OpenEXR, whose exceptions end
// here.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/exr_output.h"

#include "formats/base/assert.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <string>

namespace hearth::viewer
{

namespace
{

constexpr size_t kChannels = 3;
constexpr float kMaxHalf = 65504;

class MemoryStream final : public Imf::OStream
{
public:
    explicit MemoryStream(std::vector<std::byte>& bytes) : OStream("(memory)"), bytes_(bytes) {}

    void write(const char data[], int count) override
    {
        const auto size = static_cast<size_t>(count);
        bytes_.resize(std::max(bytes_.size(), position_ + size));
        std::memcpy(bytes_.data() + position_, data, size);
        position_ += size;
    }

    uint64_t tellp() override { return position_; }
    void seekp(uint64_t position) override { position_ = position; }

private:
    std::vector<std::byte>& bytes_;
    size_t position_ = 0;
};

std::vector<half> toHalves(std::span<const float> rgb)
{
    std::vector<half> halves(rgb.size());
    std::transform(rgb.begin(), rgb.end(), halves.begin(),
                   [](float value) { return half(std::clamp(value, -kMaxHalf, kMaxHalf)); });
    return halves;
}

void write(std::vector<std::byte>& file, std::vector<half>& rgb, uint32_t width, uint32_t height)
{
    Imf::Header header(static_cast<int>(width), static_cast<int>(height));
    Imf::FrameBuffer pixels;
    constexpr const char* kNames[kChannels] = {"R", "G", "B"};
    for (size_t c = 0; c < kChannels; ++c)
    {
        header.channels().insert(kNames[c], Imf::Channel(Imf::HALF));
        pixels.insert(kNames[c], Imf::Slice(Imf::HALF, reinterpret_cast<char*>(rgb.data() + c),
                                            kChannels * sizeof(half), kChannels * sizeof(half) * width));
    }
    MemoryStream stream(file);
    Imf::OutputFile output(stream, header);
    output.setFrameBuffer(pixels);
    output.writePixels(static_cast<int>(height));
}

} // namespace

Result<std::vector<std::byte>> encodeExr(std::span<const float> rgb, uint32_t width, uint32_t height)
{
    HEARTH_ASSERT(rgb.size() == kChannels * width * height);
    std::vector<std::byte> file;
    std::vector<half> halves = toHalves(rgb);
    try
    {
        write(file, halves, width, height);
    }
    catch (const std::exception& exception)
    {
        return Error{Issue::internal, "", "", std::string("the OpenEXR encoder failed: ") + exception.what()};
    }
    return file;
}

} // namespace hearth::viewer
