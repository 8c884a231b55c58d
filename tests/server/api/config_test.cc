#include "server/config.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "server/version.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::server {
namespace {

using Strings = std::vector<std::string>;

class ConfigTest : public testing::Test {
  protected:
    ~ConfigTest() override {
        for (const std::string& name : variables_) unsetenv(name.c_str());
    }
    void set(const std::string& name, const std::string& value) {
        setenv(name.c_str(), value.c_str(), 1);
        variables_.push_back(name);
    }
    std::string file(const std::string& text) {
        schema::write_bytes(folder_.file("haarmony.toml"), text);
        return folder_.file("haarmony.toml");
    }

    static std::variant<Config, Leave> read(const Strings& arguments) {
        std::vector<const char*> argv{"haarmonyd"};
        for (const std::string& argument : arguments) argv.push_back(argument.c_str());
        return read_config(static_cast<int>(argv.size()), argv.data());
    }
    static Config config(Strings arguments) {
        const auto result = read(arguments);
        const auto* leave = std::get_if<Leave>(&result);
        EXPECT_EQ(leave, nullptr) << leave->text;
        return leave == nullptr ? std::get<Config>(result) : Config();
    }
    // A usage error that names `what`.
    static void expect_refused(const Strings& arguments, const std::string& what) {
        const auto result = read(arguments);
        const auto* leave = std::get_if<Leave>(&result);
        ASSERT_NE(leave, nullptr) << what;
        EXPECT_EQ(leave->exit_code, kExitUsage) << what;
        EXPECT_NE(leave->text.find(what), std::string::npos) << leave->text;
    }

    schema::ScratchFolder folder_;

  private:
    Strings variables_;
};

TEST_F(ConfigTest, DefaultsAreSafe) {
    const Config defaults = config({"--db", "x.db"});
    EXPECT_EQ(defaults.database, "x.db");
    EXPECT_EQ(defaults.host, "127.0.0.1");
    EXPECT_EQ(defaults.port, 8080);
    EXPECT_FALSE(defaults.web);
    EXPECT_TRUE(defaults.media_roots.empty());
    EXPECT_FALSE(defaults.api_key_file);
    EXPECT_FALSE(defaults.allow_url_fetch);
    EXPECT_EQ(defaults.max_body, 67'108'864U);
    EXPECT_EQ(defaults.index_m, 60);
    EXPECT_EQ(defaults.log_level, "info");
    EXPECT_GE(defaults.threads, 1);
}

TEST_F(ConfigTest, FlagsAreRead) {
    const Config read = config({"--db=x.db",   "--listen",
                                "[::1]:0",     "--web",
                                "w",           "--threads",
                                "3",           "--media-root",
                                "a:b",         "--media-root",
                                "c",           "--api-key-file",
                                "keys",        "--allow-url-fetch",
                                "--max-body",  "1000",
                                "--index-m",   "100",
                                "--log-level", "debug"});
    EXPECT_EQ(read.host, "::1");
    EXPECT_EQ(read.port, 0);
    EXPECT_EQ(read.web, "w");
    EXPECT_EQ(read.threads, 3);
    EXPECT_EQ(read.media_roots, (Strings{"a:b", "c"}));
    EXPECT_EQ(read.api_key_file, "keys");
    EXPECT_TRUE(read.allow_url_fetch);
    EXPECT_EQ(read.max_body, 1000U);
    EXPECT_EQ(read.index_m, 100);
    EXPECT_EQ(read.log_level, "debug");
}

TEST_F(ConfigTest, VariablesAreRead) {
    set("HAARMONY_DB", "e.db");
    set("HAARMONY_LISTEN", "0.0.0.0:81");
    set("HAARMONY_WEB", "w");
    set("HAARMONY_THREADS", "5");
    set("HAARMONY_MEDIA_ROOT", "/a:/b");
    set("HAARMONY_API_KEY_FILE", "keys");
    set("HAARMONY_ALLOW_URL_FETCH", "true");
    set("HAARMONY_MAX_BODY", "7");
    set("HAARMONY_INDEX_M", "50");
    set("HAARMONY_LOG_LEVEL", "warn");
    const Config read = config({});
    EXPECT_EQ(read.database, "e.db");
    EXPECT_EQ(read.host, "0.0.0.0");
    EXPECT_EQ(read.port, 81);
    EXPECT_EQ(read.web, "w");
    EXPECT_EQ(read.threads, 5);
    EXPECT_EQ(read.media_roots, (Strings{"/a", "/b"}));
    EXPECT_EQ(read.api_key_file, "keys");
    EXPECT_TRUE(read.allow_url_fetch);
    EXPECT_EQ(read.max_body, 7U);
    EXPECT_EQ(read.index_m, 50);
    EXPECT_EQ(read.log_level, "warn");
}

TEST_F(ConfigTest, AFileIsRead) {
    const std::string path = file(
        "# the daemon\n"
        "db = \"f.db\"\n"
        "listen = \"localhost:82\"\n"
        "media-root = [\"/a\", \"/b c\"]\n"
        "allow-url-fetch = true\n"
        "index-m = 40\n");
    for (const Strings& arguments :
         {Strings{"--config", path}, Strings{"--config=" + path}}) {
        const Config read = config(arguments);
        EXPECT_EQ(read.database, "f.db");
        EXPECT_EQ(read.host, "localhost");
        EXPECT_EQ(read.port, 82);
        EXPECT_EQ(read.media_roots, (Strings{"/a", "/b c"}));
        EXPECT_TRUE(read.allow_url_fetch);
        EXPECT_EQ(read.index_m, 40);
    }
    set("HAARMONY_CONFIG", path);
    EXPECT_EQ(config({}).database, "f.db");
}

TEST_F(ConfigTest, FlagBeforeVariableBeforeFileBeforeDefault) {
    const std::string path = file(
        "db = \"f.db\"\nindex-m = 1\nthreads = 1\nmax-body = 1\nmedia-root = [\"/f\"]\n"
        "allow-url-fetch = true\n");
    set("HAARMONY_INDEX_M", "2");
    set("HAARMONY_THREADS", "2");
    set("HAARMONY_MEDIA_ROOT", "/e");
    set("HAARMONY_ALLOW_URL_FETCH", "false");
    const Config read = config({"--config", path, "--threads", "3"});
    EXPECT_EQ(read.threads, 3);
    EXPECT_EQ(read.index_m, 2);
    EXPECT_EQ(read.max_body, 1U);
    EXPECT_EQ(read.log_level, "info");
    EXPECT_EQ(read.media_roots, (Strings{"/e"}));
    EXPECT_FALSE(read.allow_url_fetch);
    EXPECT_EQ(config({"--config", path, "--media-root", "/x"}).media_roots,
              (Strings{"/x"}));
}

TEST_F(ConfigTest, HelpAndVersionAreNoErrors) {
    const auto version = read({"--version"});
    ASSERT_NE(std::get_if<Leave>(&version), nullptr);
    EXPECT_EQ(std::get<Leave>(version).exit_code, 0);
    EXPECT_EQ(std::get<Leave>(version).text, "haarmonyd " + std::string(kVersion) + "\n");
    const auto help = read({"--help"});
    ASSERT_NE(std::get_if<Leave>(&help), nullptr);
    EXPECT_EQ(std::get<Leave>(help).exit_code, 0);
    for (const char* flag : {"--db",
                             "--listen",
                             "--web",
                             "--threads",
                             "--media-root",
                             "--api-key-file",
                             "--allow-url-fetch",
                             "--config",
                             "--max-body",
                             "--index-m",
                             "--log-level",
                             "--version",
                             "--help",
                             "--healthcheck"})
        EXPECT_NE(std::get<Leave>(help).text.find(flag), std::string::npos) << flag;
}

TEST_F(ConfigTest, AHealthCheckNeedsNoDatabase) {
    EXPECT_TRUE(config({"--healthcheck"}).healthcheck);
}

TEST_F(ConfigTest, UsageErrorsNameWhatIsWrong) {
    const std::vector<std::pair<Strings, std::string>> cases{
        {{}, "--db"},
        {{"--db"}, "--db"},
        {{"--db", "x", "--iqdb-listen", "127.0.0.1:5588"}, "--iqdb-listen"},
        {{"--db", "x", "extra"}, "extra"},
        {{"--db", "x", "--listen", "8080"}, "8080"},
        {{"--db", "x", "--listen", "host:port"}, "host:port"},
        {{"--db", "x", "--threads", "0"}, "--threads"},
        {{"--db", "x", "--threads", "many"}, "--threads"},
        {{"--db", "x", "--max-body", "0"}, "--max-body"},
        {{"--db", "x", "--index-m", "101"}, "--index-m"},
        {{"--db", "x", "--log-level", "loud"}, "--log-level"},
        {{"--db", "x", "--config", folder_.file("gone.toml")}, "gone.toml"},
    };
    for (const auto& [arguments, what] : cases) expect_refused(arguments, what);
    for (const auto& [text, what] : {std::pair{"colour = 1\n", "colour"},
                                     std::pair{"[server]\nthreads = 1\n", "server"},
                                     std::pair{"healthcheck = true\n", "healthcheck"},
                                     std::pair{"threads = \"many\"\n", "threads"}})
        expect_refused({"--db", "x", "--config", file(text)}, what);
    set("HAARMONY_THREADS", "none");
    expect_refused({"--db", "x"}, "--threads");
}

TEST(Endpoint, HostsAndPortsAreTakenApart) {
    const std::vector<std::tuple<std::string, std::string, int>> good{
        {"127.0.0.1:8080", "127.0.0.1", 8080},
        {"localhost:0", "localhost", 0},
        {"[::1]:65535", "::1", 65535},
        {"[::]:80", "::", 80},
    };
    for (const auto& [text, host, port] : good) {
        const auto endpoint = parse_endpoint(text);
        ASSERT_TRUE(endpoint) << text;
        EXPECT_EQ(endpoint->host, host);
        EXPECT_EQ(endpoint->port, port);
    }
    for (const char* bad : {"",
                            "8080",
                            ":8080",
                            "host",
                            "host:",
                            "host:65536",
                            "host:-1",
                            "host:80x",
                            "::1:80",
                            "[::1]",
                            "[::1:80",
                            "[host]:80",
                            "[]:80"})
        EXPECT_FALSE(parse_endpoint(bad)) << bad;
    EXPECT_EQ(address_of("127.0.0.1", 8080), "http://127.0.0.1:8080");
    EXPECT_EQ(address_of("::1", 80), "http://[::1]:80");
}

}  // namespace
}  // namespace haarmony::server
