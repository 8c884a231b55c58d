#include "ingest/walk.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <memory>
#include <span>
#include <system_error>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "ingest/file_descriptor.h"
#include "ingest/file_uri.h"
#include "ingest/sniff.h"
#include "ingest/video_format.h"

namespace haarmony::ingest {
namespace {

Error system_error(int number) {
    const bool gone = number == ENOENT || number == ENOTDIR;
    return {gone ? ErrorCode::kNotFound : ErrorCode::kIo,
            std::generic_category().message(number),
            {}};
}

struct CloseFolder {
    void operator()(DIR* folder) const { ::closedir(folder); }
};
using Folder = std::unique_ptr<DIR, CloseFolder>;

std::string join(const std::string& folder, const std::string& name) {
    return folder == "/" ? folder + name : folder + '/' + name;
}

class Walk {
  public:
    Walk(const WalkOptions& options, const WalkEvents& events)
        : options_(options), events_(events) {}

    WalkSummary run(const std::vector<std::string>& paths) {
        std::vector<std::string> folders;
        bool going = true;
        for (const std::string& path : paths) {
            going = going && sort_out(path, folders);
        }
        for (const std::string& folder : folders) {
            going = going && (named_folders_[folder] || walk_below(folder));
        }
        summary_.finished = going;
        return std::move(summary_);
    }

  private:
    // Takes a PATH that is a file at once, and keeps one that is a folder for later.
    bool sort_out(const std::string& path, std::vector<std::string>& folders) {
        Result<std::string> normal = normal_path(path);
        if (!normal) return events_.on_failure(path, normal.error());
        const FileDescriptor file = open_path(*normal, O_PATH);
        struct stat status {};
        if (!file.valid() || ::fstat(file.get(), &status) != 0) {
            return events_.on_failure(*normal, system_error(errno));
        }
        if (S_ISDIR(status.st_mode)) {
            if (named_folders_.emplace(*normal, false).second) folders.push_back(*normal);
            return true;
        }
        if (!S_ISREG(status.st_mode)) {
            return events_.on_failure(
                *normal,
                {ErrorCode::kInvalidArgument, "is neither a file nor a folder", {}});
        }
        if (is_own(status)) {
            return events_.on_failure(
                *normal, {ErrorCode::kInvalidArgument, "is the database itself", {}});
        }
        if (!named_files_.insert(*normal).second) return true;
        summary_.reached.push_back(*normal);
        const std::string name = normal->substr(normal->rfind('/') + 1);
        if (is_excluded(name, false)) return true;
        return events_.keep_going() && events_.on_file({*normal, look_of(status)});
    }

    bool walk_below(const std::string& root) {
        std::vector<std::string> pending{root};
        while (!pending.empty()) {
            const std::string path = std::move(pending.back());
            pending.pop_back();
            if (!events_.keep_going()) return false;
            // Another PATH may lie below this one, or above it and have been walked before.
            if (const auto named = named_folders_.find(path);
                named != named_folders_.end()) {
                if (named->second) continue;
                named->second = true;
            }
            if (!walk_folder(root, path, pending)) return false;
        }
        return true;
    }

    bool walk_folder(const std::string& root,
                     const std::string& path,
                     std::vector<std::string>& pending) {
        const bool is_root = path == root;
        const int follow = is_root ? 0 : O_NOFOLLOW;
        FileDescriptor descriptor = open_path(path, O_RDONLY | O_DIRECTORY | follow);
        if (!descriptor.valid()) return failed_folder(path, is_root, errno);
        Folder folder(::fdopendir(descriptor.get()));
        if (!folder) return failed_folder(path, is_root, errno);
        const int number = descriptor.release();

        std::vector<std::string> names;
        errno = 0;
        while (const dirent* entry = ::readdir(folder.get())) {
            const std::string_view name = entry->d_name;
            if (name != "." && name != "..") names.emplace_back(name);
            errno = 0;
        }
        const int read_error = errno;
        std::sort(names.begin(), names.end());
        if (is_root && read_error == 0) summary_.reached.push_back(root);

        std::vector<std::string> folders;
        for (std::string& name : names) {
            if (!events_.keep_going()) return false;
            struct stat entry {};
            if (::fstatat(number, name.c_str(), &entry, AT_SYMLINK_NOFOLLOW) != 0)
                continue;
            std::string below = join(path, name);
            const std::string_view below_root =
                std::string_view(below).substr(root == "/" ? 1 : root.size() + 1);
            if (S_ISDIR(entry.st_mode)) {
                if (!is_excluded(below_root, true)) folders.push_back(std::move(below));
                continue;
            }
            if (S_ISLNK(entry.st_mode) &&
                (!options_.file_links ||
                 ::fstatat(number, name.c_str(), &entry, 0) != 0)) {
                continue;
            }
            if (!S_ISREG(entry.st_mode) || is_own(entry) ||
                is_excluded(below_root, false) || named_files_.contains(below)) {
                continue;
            }
            if (!is_candidate(number, name)) continue;
            if (!events_.on_file({std::move(below), look_of(entry)})) return false;
        }
        std::move(folders.rbegin(), folders.rend(), std::back_inserter(pending));
        if (read_error != 0) return failed_folder(path, is_root, read_error);
        return true;
    }

    // A folder that vanished since its parent was read was never there.
    bool failed_folder(const std::string& path, bool is_root, int number) {
        const Error error = system_error(number);
        if (!is_root && (error.code == ErrorCode::kNotFound || number == ELOOP))
            return true;
        return events_.on_failure(path, error);
    }

    bool is_candidate(int folder, const std::string& name) const {
        return has_picture_extension(name) ||
               (options_.films && has_film_extension(name)) ||
               begins_like_candidate(folder, name);
    }

    bool begins_like_candidate(int folder, const std::string& name) const {
        // The file may have become a fifo: O_NONBLOCK keeps open() from waiting for a writer.
        const FileDescriptor file(
            ::openat(folder, name.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
        struct stat status {};
        if (!file.valid() || ::fstat(file.get(), &status) != 0 ||
            !S_ISREG(status.st_mode)) {
            return false;
        }
        std::array<std::uint8_t, kSniffBytes> begin{};
        const ssize_t count = ::pread(file.get(), begin.data(), begin.size(), 0);
        if (count <= 0) return false;
        const auto bytes = std::span(begin).first(static_cast<std::size_t>(count));
        const auto type = sniff(bytes);
        if (type && type->format) return true;
        if (!options_.films || has_sound_extension(name)) return false;
        const auto clip = sniff_video(bytes);
        return clip && is_film(*clip);
    }

    bool is_excluded(std::string_view below, bool is_folder) const {
        return std::any_of(options_.exclude.begin(),
                           options_.exclude.end(),
                           [&](const Exclusion& exclusion) {
                               return exclusion.matches(below, is_folder);
                           });
    }

    bool is_own(const struct stat& status) const {
        const FileIdentity identity{status.st_dev, status.st_ino};
        return std::find(options_.own_files.begin(),
                         options_.own_files.end(),
                         identity) != options_.own_files.end();
    }

    const WalkOptions& options_;
    const WalkEvents& events_;
    WalkSummary summary_;
    std::unordered_set<std::string> named_files_;
    std::unordered_map<std::string, bool> named_folders_;  // whether it has been walked
};

}  // namespace

// Times outside what an int64 of nanoseconds holds are cut to its ends.
FileLook look_of(const struct stat& status) {
    constexpr std::int64_t kBillion = 1'000'000'000;
    std::int64_t mtime_ns = 0;
    if (__builtin_mul_overflow(
            std::int64_t{status.st_mtim.tv_sec}, kBillion, &mtime_ns) ||
        __builtin_add_overflow(
            mtime_ns, std::int64_t{status.st_mtim.tv_nsec}, &mtime_ns)) {
        mtime_ns = status.st_mtim.tv_sec < 0 ? std::numeric_limits<std::int64_t>::min()
                                             : std::numeric_limits<std::int64_t>::max();
    }
    return {status.st_size, mtime_ns};
}

std::vector<FileIdentity> database_files(const std::string& path) {
    std::vector<FileIdentity> files;
    for (const char* suffix : {"", "-wal", "-shm", "-journal"}) {
        struct stat status {};
        if (::stat((path + suffix).c_str(), &status) == 0) {
            files.push_back({status.st_dev, status.st_ino});
        }
    }
    return files;
}

WalkSummary walk(const std::vector<std::string>& paths,
                 const WalkOptions& options,
                 const WalkEvents& events) {
    return Walk(options, events).run(paths);
}

}  // namespace haarmony::ingest
