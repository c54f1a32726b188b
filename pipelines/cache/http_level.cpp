// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cache/http_level.h"

namespace hearth::cache
{

namespace
{

// The longest entries are the lists of files that an import found: 16 times some hundred bytes for each of
// its files.
constexpr uint64_t kMaxEntry_bytes = 64 << 20;

bool isThere(const HttpRequest& request)
{
    return request.status == kHttpOk;
}

/// True if the server does not have the file (404 Not Found, 410 Gone).
bool isNotThere(const HttpRequest& request)
{
    return request.status == 404 || request.status == 410;
}

bool isKept(const HttpRequest& request)
{
    return request.status >= 200 && request.status < 300;
}

} // namespace

std::string withoutUser(const std::string& url)
{
    const size_t host = url.find("//") + 2;
    const size_t at = url.substr(0, url.find('/', host)).rfind('@');
    return at == std::string::npos ? url : url.substr(0, host) + url.substr(at + 1);
}

HttpLevel::HttpLevel(std::string url, bool writable, const Pace& pace)
    : url_(std::move(url)), name_(withoutUser(url_)), writable_(writable), pace_(pace)
{
}

HttpLevel::~HttpLevel() = default;

Status HttpLevel::run(std::span<HttpRequest> requests)
{
    if (!client_)
    {
        HEARTH_ASSIGN_OR_RETURN(client_, HttpClient::open(name_, pace_));
    }
    return client_->run(requests);
}

Error HttpLevel::answered(const HttpRequest& request, const std::string& consequence) const
{
    return {Issue::cache_failed, name_, request.url.substr(url_.size()),
            "the server answers with status " + std::to_string(request.status) + ": " + consequence};
}

Status HttpLevel::entries(std::span<WantedEntry> wanted)
{
    std::vector<HttpRequest> requests;
    std::vector<WantedEntry*> asked;
    for (WantedEntry& entry : wanted)
        if (!entry.text)
        {
            requests.push_back(
                {HttpRequest::Kind::get_text, url_ + "/ac/" + entry.key, "", "", kMaxEntry_bytes});
            asked.push_back(&entry);
        }
    if (requests.empty())
        return success();
    Status status = run(requests);
    for (size_t i = 0; i < requests.size(); ++i)
        if (isThere(requests[i]))
            asked[i]->text = std::move(requests[i].text);
        else if (status.ok() && !isNotThere(requests[i]))
            status = answered(requests[i], "it is not asked again");
    return status;
}

Status HttpLevel::fetch(std::span<WantedContent> wanted)
{
    std::vector<HttpRequest> requests;
    std::vector<WantedContent*> asked;
    for (WantedContent& content : wanted)
        if (!content.is_there)
        {
            requests.push_back({HttpRequest::Kind::get_file, url_ + "/cas/" + content.hash, "", content.path,
                                content.bytes});
            asked.push_back(&content);
        }
    if (requests.empty())
        return success();
    Status status = run(requests);
    for (size_t i = 0; i < requests.size(); ++i)
    {
        asked[i]->is_there = isThere(requests[i]);
        if (status.ok() && !isThere(requests[i]) && !isNotThere(requests[i]))
            status = answered(requests[i], "it is not asked again");
    }
    return status;
}

Status HttpLevel::put(HttpRequest request)
{
    HEARTH_TRY(run({&request, 1}));
    if (isKept(request))
        return success();
    writable_ = false;
    return answered(request, "nothing more is put there");
}

Status HttpLevel::putEntry(const std::string& key, const std::string& text)
{
    return put({HttpRequest::Kind::put_text, url_ + "/ac/" + key, text, ""});
}

Status HttpLevel::put(const std::string& hash, const std::string& path, Use)
{
    return put({HttpRequest::Kind::put_file, url_ + "/cas/" + hash, "", path});
}

} // namespace hearth::cache
