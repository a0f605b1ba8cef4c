// Where layers of fur lie, whose number grows by degrees. A power of two of them are equally thick; as further ones are asked for, the thick ones
// are halved, the outermost first, where silhouettes and most of what is seen are. 6.25 layers are four, two of which are halved and the third
// an eighth of the way: the part that opens at its top is yet an eighth of a half. So no more than one layer moves at a time, by as much as the number
// changes, and those that show most are the thinnest.
// The height at which layer i ends, counted from the outermost, which ends at 1; that of the one after the last is 0. `layers` is at least 1.
float layer_top(int i, float layers) {
    float thick = 1.0f;
    while (2.0f * thick <= layers) thick *= 2.0f;
    float split = layers - thick, halved = floor(split), part = split - halved;
    float above = 0.5f * float(i);  // in thick layers
    if (above > halved) {
        float below = float(i) - 2.0f * halved - (part > 0.0f ? 1.0f : 0.0f);
        above = halved + (below > 0.0f ? below : 0.5f * part);
    }
    return 1.0f - above / thick;
}
