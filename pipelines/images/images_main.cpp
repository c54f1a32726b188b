// hearth-images: decodes images for hearth-import, which starts it. It reads requests from its standard
// input, a socket, and answers on its standard output; it has no command line and opens no file.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/images/assemble.h"
#include "pipelines/images/confine.h"
#include "pipelines/images/read_oiio.h"
#include "pipelines/images/read_psd.h"

#include <cerrno>
#include <cstdio>
#include <exception>
#include <new>
#include <unistd.h>

namespace
{

using namespace hearth;
using namespace hearth::images;

/// Read `size` bytes; false if the input ends before.
bool readAll(void* to, size_t size)
{
    auto* bytes = static_cast<std::byte*>(to);
    while (size > 0)
    {
        const ssize_t got = ::read(STDIN_FILENO, bytes, size);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            return false;
        bytes += got;
        size -= static_cast<size_t>(got);
    }
    return true;
}

bool writeAll(const void* from, size_t size)
{
    const auto* bytes = static_cast<const std::byte*>(from);
    while (size > 0)
    {
        const ssize_t put = ::write(STDOUT_FILENO, bytes, size);
        if (put < 0 && errno == EINTR)
            continue;
        if (put <= 0)
            return false;
        bytes += put;
        size -= static_cast<size_t>(put);
    }
    return true;
}

Result<Samples> readSamples(const Request& request, std::string_view layer, std::span<const std::byte> bytes)
{
    try
    {
        return request.format == Format::psd ? readPsd(request, bytes) : readByOiio(request, layer, bytes);
    }
    catch (const std::bad_alloc&)
    {
        return Error{Issue::input_too_large, "", "", "decoding the image takes more than 4 GiB of memory"};
    }
    catch (const std::exception& problem)
    {
        return Error{Issue::image_malformed, "", "", problem.what()};
    }
}

bool refuse(const Error& error)
{
    Answer answer;
    answer.issue = static_cast<uint32_t>(error.issue);
    const std::string text = error.detail.substr(0, kMaxTextSize);
    answer.text_size = static_cast<uint32_t>(text.size());
    return writeAll(&answer, sizeof(answer)) && writeAll(text.data(), text.size());
}

bool send(const Samples& samples, const Assembled& image)
{
    Answer answer;
    answer.width = image.width;
    answer.height = image.height;
    answer.type = static_cast<uint32_t>(samples.number);
    const std::string text = samples.notes.substr(0, kMaxTextSize);
    answer.text_size = static_cast<uint32_t>(text.size());
    answer.texel_bytes = image.texels.size();
    return writeAll(&answer, sizeof(answer)) && writeAll(text.data(), text.size()) &&
           writeAll(image.texels.data(), image.texels.size());
}

/// Answer one request; false if there is none.
bool serve()
{
    Request request;
    if (!readAll(&request, sizeof(request)) || request.magic != kRequestMagic ||
        request.layer_size > kMaxLayerSize || request.byte_count > kMaxMemory_bytes)
        return false;
    renewCpuLimit();
    std::string layer(request.layer_size, '\0');
    std::vector<std::byte> bytes(request.byte_count);
    if (!readAll(layer.data(), layer.size()) || !readAll(bytes.data(), bytes.size()))
        return false;
    Result<Samples> samples = readSamples(request, layer, bytes);
    if (!samples.ok())
        return refuse(samples.error());
    return send(*samples, assemble(*samples, request.convert_icc != 0));
}

} // namespace

int main(int argc, char**)
{
    if (argc > 1 || ::isatty(STDIN_FILENO) != 0)
    {
        std::fprintf(stderr, "hearth-images decodes images for hearth-import, which starts it.\n");
        return 2;
    }
    try
    {
        limitResources();
        prepareReaders();
        closeDoors();
        while (serve())
        {
        }
        // without destructors: those of 262 libraries take time and have nothing to save
        ::_exit(0);
    }
    catch (...)
    {
        ::_exit(70);
    }
}
