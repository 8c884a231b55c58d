#include "tests/bench/http/posters.h"

#include <stdexcept>

#include "tests/support/http_client.h"

namespace haarmony::bench {

Posters::Posters(std::uint16_t port, int clients, const std::string& picture) {
    for (int i = 0; i < clients; ++i)
        threads_.emplace_back([this, port, &picture] { post(port, picture); });
}

Posters::~Posters() {
    ending_ = true;
    for (std::thread& thread : threads_) thread.join();
}

void Posters::post(std::uint16_t port, const std::string& picture) {
    try {
        test::HttpClient client(port);
        while (!ending_) {
            const int status =
                client.request("POST", "/query", "Content-Type: image/jpeg\r\n", picture)
                    .status;
            ++(status == 200 ? answered_ : status == 503 ? refused_ : failed_);
        }
    } catch (const std::runtime_error&) {
        ++failed_;
    }
}

}  // namespace haarmony::bench
