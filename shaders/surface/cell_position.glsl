// Where a ray stands over the cells of a map, to a few 1e-7 of a cell however long the ray and however large the map. Plain
// float arithmetic loses one part in 2^24 of the whole way (1e-4 of a cell after 1700 cells), which beside a one-texel spike is
// 1e-4 of the height: enough to miss it. Here the way is split by floor() into integers, whose products are exact, and rests
// below 1/1000, whose rounding no longer counts; no step relies on the compiler keeping an order of float operations.
#ifndef RELIEVO_SURFACE_CELL_POSITION
#define RELIEVO_SURFACE_CELL_POSITION

// A position along one axis in cells, as cell + inside; inside lies within 1 of [0,1).
struct CellPosition {
    int cell;
    float inside;
};

// (uv - below * uv_per_height) * texels - 0.5, of a map of at most 2^14 texels; `below` in [-1,1] is the polygon's height minus
// the ray's.
CellPosition cell_position(float uv, float uv_per_height, float below, int texels) {
    int shift = abs(uv_per_height) < 64.0f ? 11 : 3;  // the product of a and c has to fit 31 bits; flatter rays lose digits
    float grid = float(1 << shift);
    int a = int(floor(uv_per_height * grid));
    int c = int(floor(below * 4096.0f));
    int u = int(floor(uv * 4096.0f));
    float a_rest = uv_per_height - float(a) / grid;
    float c_rest = below - float(c) / 4096.0f;
    float u_rest = uv - float(u) / 4096.0f;

    int product = a * c;  // in units of 1 / (4096 grid)
    int whole = u - (product >> shift);
    float part = float(product & ((1 << shift) - 1)) / (4096.0f * grid);
    float rest = (u_rest - part) - (float(a) / grid * c_rest + a_rest * below);

    int fine = (whole & 4095) * texels;  // in units of 1/4096 cell
    CellPosition p;
    p.cell = (whole >> 12) * texels + (fine >> 12);
    p.inside = float(fine & 4095) / 4096.0f - 0.5f + rest * float(texels);
    return p;
}

#endif
