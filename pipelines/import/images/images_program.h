// Starts hearth-images, which decodes what this process does not read itself, and talks to it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/images/protocol.h"
#include "pipelines/import/images/codecs.h"

#include <chrono>
#include <string>
#include <sys/types.h>

namespace hearth::import
{

/// The program hearth-images. It is started by the first image and serves further ones; one that fails is
/// replaced. Its bytes are as hostile as those of the image. Not thread-safe.
class ImagesProgram
{
public:
    /// path     of the program, which need not exist
    /// timeout  of an image, with starting the program
    explicit ImagesProgram(std::string path, std::chrono::milliseconds timeout = std::chrono::seconds(60))
        : path_(std::move(path)), timeout_(timeout)
    {
    }
    ~ImagesProgram() { end(); }
    ImagesProgram(const ImagesProgram&) = delete;
    ImagesProgram& operator=(const ImagesProgram&) = delete;

    /// Decode an image.
    /// format  what its signature says
    /// layer   of an EXR: name of a part, or of a layer in a part; empty: the first part with colours
    /// errors: image_malformed, image_unsupported (also: there is no such program), input_too_large,
    ///         image_reader where the program crashes, answers nonsense, or takes too long
    Result<DecodedImage> decode(images::Format format, const EncodedImage& source, const std::string& layer,
                                bool convert_icc);

    /// True if the program has been started.
    bool wasStarted() const { return was_started_; }
    const std::string& path() const { return path_; }

private:
    using Time = std::chrono::steady_clock::time_point;

    bool start();
    /// End the program. returns  its status, as from waitpid()
    int end();
    bool waitFor(short events, Time deadline);
    bool send(const void* data, size_t size, Time deadline);
    bool receive(void* data, size_t size, Time deadline);
    Error failure(const EncodedImage& source, Time deadline);
    Result<DecodedImage> receiveImage(const EncodedImage& source, const images::Answer& answer,
                                      Time deadline);

    std::string path_;
    std::chrono::milliseconds timeout_;
    pid_t process_ = -1;
    int socket_ = -1;
    bool was_started_ = false;
};

} // namespace hearth::import
