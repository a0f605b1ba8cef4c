// What the programs that bake the cell cone map are told (shaders/hosts/maps/cell_cone_*.comp).
#ifndef RELIEVO_SHARED_CELL_CONE_BAKE_H
#define RELIEVO_SHARED_CELL_CONE_BAKE_H

struct CellConeStep {
    int width, height;          // cells
    int first_row;              // of this dispatch
    int have, covered;          // a square of `covered` cells is roofed by squares of `have` cells
    int bits;                   // where the roof of this step stands in a cell's word
    int back_near_x, back_near_y;      // from a cell to where the square begins that ends at it, wrapped
    int back_middle_x, back_middle_y;
    int back_far_x, back_far_y;
};

#endif
