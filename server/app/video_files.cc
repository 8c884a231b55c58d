#include "server/app/video_files.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <set>
#include <utility>

#include "server/app/file_spool.h"
#include "server/app/log_value.h"

namespace haarmony::server {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kInput = "input-";
constexpr std::string_view kBuilding = "building-";

Result<void> write_all(int descriptor,
                       std::span<const std::byte> bytes,
                       const std::string& path) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return system_error(path, "written");
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return {};
}

void remove_file(const std::string& path) {
    if (::unlink(path.c_str()) != 0 && errno != ENOENT)
        spdlog::warn("event=file_not_removed reason={}",
                     log_value(system_error(path, "removed").message));
}

bool all_digits(std::string_view text) {
    return !text.empty() &&
           text.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace

bool is_input_name(std::string_view name) {
    return name.starts_with(kInput) && all_digits(name.substr(kInput.size()));
}

VideoFiles::VideoFiles(const std::string& database_path)
    : folder_(database_path + ".videos") {}

Result<void> VideoFiles::prepare() const {
    if (::mkdir(folder_.c_str(), 0755) == 0 || errno == EEXIST) return {};
    return system_error(folder_, "made");
}

std::string VideoFiles::clip_path(std::int64_t id, std::string_view revision) const {
    return folder_ + '/' + std::to_string(id) + '-' + std::string(revision) + ".mrv";
}

std::string VideoFiles::building_path(std::int64_t job) const {
    return folder_ + '/' + std::string(kBuilding) + std::to_string(job);
}

std::string VideoFiles::input_path(std::string_view input) const {
    return folder_ + '/' + std::string(input);
}

Result<std::string> VideoFiles::take_input(std::span<const std::byte> bytes) {
    for (;;) {
        const std::string name = std::string(kInput) + std::to_string(next_input_++);
        const std::string path = input_path(name);
        const FileDescriptor file(
            ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
        if (!file && errno == EEXIST) continue;
        if (!file) return system_error(path, "made");
        Result<void> done = write_all(file.get(), bytes, path);
        if (done && ::fsync(file.get()) != 0) done = system_error(path, "synchronised");
        if (done) done = sync_folder();
        if (done) return name;
        remove_file(path);
        return done.error();
    }
}

void VideoFiles::remove_input(std::string_view input) const {
    remove_file(input_path(input));
}

void VideoFiles::remove_clip(const schema::Video& video) const {
    remove_file(clip_path(video.id, video.revision));
}

Result<std::uint64_t> VideoFiles::free_bytes() const {
    struct statvfs disk {};
    if (::statvfs(folder_.c_str(), &disk) != 0) return system_error(folder_, "looked at");
    return std::uint64_t{disk.f_bavail} * disk.f_frsize;
}

Result<void> VideoFiles::publish(const std::string& built,
                                 const schema::Video& video) const {
    const std::string path = clip_path(video.id, video.revision);
    if (std::rename(built.c_str(), path.c_str()) != 0)
        return system_error(path, "renamed to");
    return sync_folder();
}

Result<void> VideoFiles::sync_folder() const {
    const FileDescriptor opened(
        ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!opened) return system_error(folder_, "opened");
    if (::fsync(opened.get()) != 0) return system_error(folder_, "synchronised");
    return {};
}

Result<std::int64_t> VideoFiles::sweep(
    std::span<const schema::Video> videos,
    const std::function<bool(std::string_view input)>& wants) const {
    std::set<std::string> clips;
    for (const schema::Video& video : videos)
        clips.insert(fs::path(clip_path(video.id, video.revision)).filename());
    std::error_code error;
    std::int64_t removed = 0;
    for (fs::directory_iterator file(folder_, error), end; !error && file != end;
         file.increment(error)) {
        const std::string name = file->path().filename();
        const bool orphan = name.ends_with(".mrv")                 ? !clips.contains(name)
                            : name.starts_with(kBuilding)          ? true
                            : name.starts_with(FileSpool::kMoment) ? true
                            : is_input_name(name)                  ? !wants(name)
                                                                   : false;
        if (!orphan) continue;
        remove_file(file->path());
        ++removed;
    }
    if (error)
        return Error{ErrorCode::kIo, folder_ + ": cannot be read: " + error.message()};
    return removed;
}

}  // namespace haarmony::server
