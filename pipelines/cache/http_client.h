// Requests to a server of a cache, many at once: libcurl behind an interface, loaded when it is first needed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/cache/stall_timer.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace hearth::cache
{

inline constexpr long kHttpOk = 200;

/// A GET or PUT of a text or of a file.
struct HttpRequest
{
    enum class Kind
    {
        get_text, ///< `text` is what came; after a status other than 200 it means nothing
        get_file, ///< a new file at `path`, which is there where the status is 200
        put_text,
        put_file,
    };
    Kind kind = Kind::get_text;
    std::string url;
    std::string text;
    std::string path;
    uint64_t max_bytes = UINT64_MAX; ///< what a get may bring; the rest is cut off
    long status = 0;                 ///< of the answer; 0: there is none
};

/// Connections to a server, which are kept open from request to request.
class HttpClient
{
public:
    /// name    of the level, for messages
    /// errors  cache_failed: libcurl is not installed
    static Result<std::unique_ptr<HttpClient>> open(const std::string& name, const Pace& pace);

    HttpClient(const HttpClient&) = delete;
    HttpClient& operator=(const HttpClient&) = delete;
    ~HttpClient();

    /// Send them all, at most kConnections at once, and wait for the answers, whatever status they have. Neither redirects
    /// nor cookies are followed; proxies are those of the environment (http_proxy, no_proxy).
    /// errors  cache_failed: the server cannot be reached, breaks off, or is too slow; a file cannot be written; a signal
    ///         that is blocked asks this process to end. Requests that were answered before have their status, and no file
    ///         is left of the others.
    Status run(std::span<HttpRequest> requests);

private:
    struct Connections;
    explicit HttpClient(std::unique_ptr<Connections> connections);

    std::unique_ptr<Connections> connections_;
};

} // namespace hearth::cache
