// The order in which faces are drawn, so that the vertices they share are still at hand: less work before rasterisation.
#pragma once

#include "core/mesh.h"
#include "mesh/lin_yu.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace relievo {

enum class IndexOrder { none, meshopt, fifo, lin_yu };

struct IndexOrderEntry {
    IndexOrder order;
    std::string_view id;
    std::string_view summary;
};
inline constexpr IndexOrderEntry index_orders[] = {
    {IndexOrder::none, "none", "as the file has it"},
    {IndexOrder::meshopt, "meshopt", "vertices used last and nearly done with first, in the manner of meshoptimizer: best where vertices are batched"},
    {IndexOrder::fifo, "fifo", "meshoptimizer's tipsify: quickest, for a FIFO cache"},
    {IndexOrder::lin_yu, "lin-yu", "Lin and Yu's K-cache reordering: fewest vertices for a FIFO cache"},
};

struct OrderSettings {
    IndexOrder order = IndexOrder::meshopt;
    int cache = 16;                       // vertices of the FIFO cache that fifo and lin-yu aim at, 4 to 255
    std::optional<LinYuWeights> weights;  // of lin-yu; none: those of lin_yu_weights(cache)
    std::uint32_t least_chunk = 0;        // faces; larger meshes are ordered in chunks of at least as many (0: 200,000)
    int threads = 0;
};

// The mesh with its faces in the order asked for (each possibly rotated, none turned over) and its vertices in the order in which
// the faces first use them, so that they are also fetched in a row. Vertices without faces go. Large meshes are ordered in compact
// chunks, several at a time; the result does not depend on `threads`.
Mesh ordered(Mesh mesh, const OrderSettings& settings);

}  // namespace relievo
