#include "server/http/content_encoding.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>
#include <string>

namespace haarmony::http {
namespace {

std::string gunzip(const std::string& packed) {
    z_stream stream{};
    EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
    std::string plain(10'000'000, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(plain.data());
    stream.avail_out = static_cast<uInt>(plain.size());
    EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
    EXPECT_EQ(stream.avail_in, 0U);
    plain.resize(stream.total_out);
    inflateEnd(&stream);
    return plain;
}

Response text(std::string type, std::size_t size) {
    return {.status = 200,
            .headers = {{"Content-Type", std::move(type)}, {"ETag", "\"v1\""}},
            .body = std::string(size, 'x')};
}

Request accepting(std::string encodings) {
    Request request;
    request.method = "GET";
    if (!encodings.empty()) request.headers["Accept-Encoding"] = std::move(encodings);
    return request;
}

TEST(Gzip, IsUndoneByZlib) {
    std::mt19937 random(3);
    for (const std::size_t size : {0U, 1U, 1'000U, 300'000U}) {
        std::string bytes(size, '\0');
        for (char& c : bytes) c = static_cast<char>(random() % 97);
        EXPECT_EQ(gunzip(gzip(bytes)), bytes) << size;
    }
}

TEST(Gzip, IsChosenByTheClientsWeights) {
    for (const char* yes : {"gzip",
                            "GZIP",
                            "x-gzip",
                            "deflate, gzip, br",
                            "*",
                            "gzip;q=0.001",
                            "gzip; q=1.000",
                            "identity;q=0.5, gzip;q=0.5",
                            "*;q=0.1",
                            "identity;q=0, gzip;q=0.2",
                            "gzip;Q=0.3"}) {
        EXPECT_TRUE(prefers_gzip(yes)) << yes;
    }
    for (const char* no : {"",
                           "identity",
                           "br",
                           "gzip;q=0",
                           "gzip;q=0.000",
                           "*;q=0",
                           "gzip;q=0, *",
                           "gzip;q=0.4, identity;q=0.5",
                           "gzip;q=x",
                           "gzip;q=2",
                           "gzip;q=1.001",
                           "gzip;q=0.0001",
                           "gzip;q=",
                           "gzip;level=9",
                           "gzipped",
                           "gzip;q=0,5"}) {
        EXPECT_FALSE(prefers_gzip(no)) << no;
    }
}

TEST(ContentEncoding, LongTextIsCompressedAndItsTagWeakened) {
    for (const char* type : {"application/json",
                             "application/problem+json",
                             "text/html",
                             "Text/CSS; charset=utf-8",
                             "image/svg+xml",
                             "application/x-ndjson"}) {
        Response response = text(type, 5'000);
        ASSERT_TRUE(select_gzip(accepting("gzip"), response)) << type;
        EXPECT_EQ(response.headers.at("ETag"), "W/\"v1\"");
        EXPECT_EQ(response.headers.at("Vary"), "Accept-Encoding");
        gzip_body(response);
        EXPECT_EQ(response.headers.at("Content-Encoding"), "gzip");
        EXPECT_EQ(gunzip(std::get<std::string>(response.body)), std::string(5'000, 'x'));
    }
}

TEST(ContentEncoding, VariesEvenWhenTheClientTakesPlainBytes) {
    Response response = text("application/json", 5'000);
    EXPECT_FALSE(select_gzip(accepting(""), response));
    EXPECT_EQ(response.headers.at("Vary"), "Accept-Encoding");
    EXPECT_EQ(response.headers.at("ETag"), "\"v1\"");
}

TEST(ContentEncoding, AddsToAnExistingVaryOnce) {
    Response response = text("application/json", 5'000);
    response.headers["Vary"] = "Accept";
    EXPECT_TRUE(select_gzip(accepting("gzip"), response));
    EXPECT_EQ(response.headers.at("Vary"), "Accept, Accept-Encoding");
    EXPECT_TRUE(select_gzip(accepting("gzip"), response));
    EXPECT_EQ(response.headers.at("Vary"), "Accept, Accept-Encoding");
    EXPECT_EQ(response.headers.at("ETag"), "W/\"v1\"");
    response.headers["Vary"] = "*";
    EXPECT_TRUE(select_gzip(accepting("gzip"), response));
    EXPECT_EQ(response.headers.at("Vary"), "*");
}

TEST(ContentEncoding, PicturesShortBodiesFilesAndEncodedBodiesAreLeftAlone) {
    Response picture = text("image/png", 5'000);
    EXPECT_FALSE(select_gzip(accepting("gzip"), picture));
    EXPECT_FALSE(picture.headers.contains("Vary"));
    Response shortest = text("application/json", kMinCompressed - 1);
    EXPECT_FALSE(select_gzip(accepting("gzip"), shortest));
    Response enough = text("application/json", kMinCompressed);
    EXPECT_TRUE(select_gzip(accepting("gzip"), enough));
    Response file = text("text/plain", 0);
    file.body = FileRange{.path = "p", .offset = 0, .length = 5'000};
    EXPECT_FALSE(select_gzip(accepting("gzip"), file));
    Response encoded = text("text/plain", 5'000);
    encoded.headers["Content-Encoding"] = "br";
    EXPECT_FALSE(select_gzip(accepting("gzip"), encoded));
    Response untyped = text("x", 5'000);
    untyped.headers.erase("Content-Type");
    EXPECT_FALSE(select_gzip(accepting("gzip"), untyped));
}

TEST(ContentEncoding, CompressedAnswersHaveNoRanges) {
    Response response = text("text/plain", 5'000);
    response.headers["Accept-Ranges"] = "bytes";
    EXPECT_TRUE(select_gzip(accepting("gzip"), response));
    EXPECT_FALSE(response.headers.contains("Accept-Ranges"));
}

}  // namespace
}  // namespace haarmony::http
