// HTTP client for cache servers: many concurrent requests by libcurl, which is loaded at first use.
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

/// HTTP GET or PUT of a text or of a file.
struct HttpRequest
{
    enum class Kind
    {
        get_text, ///< GET; `text` is the response body, undefined after a status other than 200
        get_file, ///< GET; writes a new file at `path` if the status is 200
        put_text,
        put_file,
    };
    Kind kind = Kind::get_text;
    std::string url;
    std::string text;
    std::string path;
    uint64_t max_bytes = UINT64_MAX; ///< limit for the response body; a larger one is cut off
    long status = 0;                 ///< HTTP status of the response; 0: none
};

/// HTTP client that keeps its connections open from request to request.
class HttpClient
{
public:
    /// name    of the level, for messages
    /// errors  cache_failed: libcurl is not installed
    static Result<std::unique_ptr<HttpClient>> open(const std::string& name, const StallLimits& limits);

    HttpClient(const HttpClient&) = delete;
    HttpClient& operator=(const HttpClient&) = delete;
    ~HttpClient();

    /// Send all requests, at most kConnections at once, and wait for the responses, whatever their status.
    /// Redirects are not followed, and cookies are not kept; proxies are those of the environment
    /// (http_proxy, no_proxy).
    /// errors  cache_failed: the server cannot be reached, breaks off, or is too slow; a file cannot be
    ///         written; a blocked signal that ends this process is pending. Requests that were answered
    ///         before have their status, and no file of the others remains.
    Status run(std::span<HttpRequest> requests);

private:
    struct Connections;
    explicit HttpClient(std::unique_ptr<Connections> connections);

    std::unique_ptr<Connections> connections_;
};

} // namespace hearth::cache
