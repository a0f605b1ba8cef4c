#include "pipeline/content_hash.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

namespace relievo {

namespace {

// FIPS 180-4, 4.2.2: the first 32 bits of the fractional parts of the cube roots of the first 64 primes, and 5.3.3: of the square
// roots of the first 8, computed in integers rather than listed.
struct Constants {
    std::array<std::uint32_t, 64> k{};
    std::array<std::uint32_t, 8> initial{};
};

// floor(2^32 p^(1/degree)) modulo 2^32, by bisection on x^degree <= p 2^(32 degree).
constexpr std::uint32_t root_fraction(unsigned prime, int degree) {
    __extension__ using Wide = unsigned __int128;
    std::uint64_t low = 0;
    std::uint64_t high = std::uint64_t{1} << 37;  // the roots are below 32
    while (high - low > 1) {
        const std::uint64_t x = (low + high) / 2;
        Wide power = 1;
        for (int i = 0; i < degree; ++i) power *= x;
        (power <= Wide{prime} << (32 * degree) ? low : high) = x;
    }
    return static_cast<std::uint32_t>(low);
}

constexpr Constants make_constants() {
    Constants c;
    std::size_t found = 0;
    for (unsigned n = 2; found < c.k.size(); ++n) {
        bool prime = true;
        for (unsigned d = 2; d * d <= n; ++d) prime = prime && n % d != 0;
        if (!prime) continue;
        c.k[found] = root_fraction(n, 3);
        if (found < c.initial.size()) c.initial[found] = root_fraction(n, 2);
        ++found;
    }
    return c;
}

constexpr Constants constants = make_constants();
static_assert(constants.k[0] == 0x428a2f98 && constants.k[63] == 0xc67178f2 && constants.initial[7] == 0x5be0cd19);

// 6.2.2: one block of 64 bytes into the state; the standard's names.
void compress(std::array<std::uint32_t, 8>& state, const std::byte* block) {
    std::array<std::uint32_t, 64> w;
    for (std::size_t t = 0; t < 16; ++t) {
        const auto byte = [&](std::size_t i) { return std::to_integer<std::uint32_t>(block[4 * t + i]); };
        w[t] = byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3);
    }
    for (std::size_t t = 16; t < 64; ++t) {
        const std::uint32_t s0 = std::rotr(w[t - 15], 7) ^ std::rotr(w[t - 15], 18) ^ (w[t - 15] >> 3);
        const std::uint32_t s1 = std::rotr(w[t - 2], 17) ^ std::rotr(w[t - 2], 19) ^ (w[t - 2] >> 10);
        w[t] = w[t - 16] + s0 + w[t - 7] + s1;
    }
    auto [a, b, c, d, e, f, g, h] = state;
    for (std::size_t t = 0; t < 64; ++t) {
        const std::uint32_t sum1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
        const std::uint32_t t1 = h + sum1 + ((e & f) ^ (~e & g)) + constants.k[t] + w[t];
        const std::uint32_t sum0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
        const std::uint32_t t2 = sum0 + ((a & b) ^ (a & c) ^ (b & c));
        h = g;
        g = f;
        f = e;
        e = d + t1;
        d = c;
        c = b;
        b = a;
        a = t1 + t2;
    }
    const std::array<std::uint32_t, 8> added{a, b, c, d, e, f, g, h};
    for (std::size_t i = 0; i < 8; ++i) state[i] += added[i];
}

}  // namespace

Digest sha256(std::span<const std::byte> bytes) {
    std::array<std::uint32_t, 8> state = constants.initial;
    const std::size_t whole = bytes.size() / 64 * 64;
    for (std::size_t at = 0; at < whole; at += 64) compress(state, bytes.data() + at);

    // 5.1.1: a one bit, zeros, and the length in bits in the last eight bytes.
    std::array<std::byte, 128> tail{};
    const std::size_t rest = bytes.size() - whole;
    std::ranges::copy(bytes.subspan(whole), tail.begin());
    tail[rest] = std::byte{0x80};
    const std::size_t end = rest < 56 ? 64 : 128;
    const std::uint64_t bits = std::uint64_t{bytes.size()} * 8;
    for (std::size_t i = 0; i < 8; ++i) tail[end - 1 - i] = static_cast<std::byte>(bits >> (8 * i));
    for (std::size_t at = 0; at < end; at += 64) compress(state, tail.data() + at);

    Digest digest;
    for (std::size_t i = 0; i < digest.size(); ++i) digest[i] = static_cast<std::uint8_t>(state[i / 4] >> (24 - 8 * (i % 4)));
    return digest;
}

Digest content_digest(std::span<const std::byte> bytes, int threads) {
    constexpr std::size_t piece = std::size_t{1} << 20;
    std::vector<Digest> digests((bytes.size() + piece - 1) / piece);
    parallel_for(static_cast<int>(digests.size()), 1, threads, [&](int begin, int end) {
        for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
            digests[k] = sha256(bytes.subspan(k * piece, std::min(piece, bytes.size() - k * piece)));
    });
    return sha256(std::as_bytes(std::span(digests)));
}

std::string hex(std::span<const std::uint8_t> bytes) {
    constexpr char digits[] = "0123456789abcdef";
    std::string text;
    for (const std::uint8_t b : bytes) {
        text += digits[b >> 4];
        text += digits[b & 15];
    }
    return text;
}

}  // namespace relievo
