// What do facets lose that reflect once? A table over roughness and cosine, made in f64 (reference/kulla_conty.rs).

// Rows are equally spaced in the cube root of alpha, columns in sqrt(1 - w), w = sqrt(alpha (1 - mu) / (mu + alpha)), both over
// 0..1; behind each row its mean over the cosine, over alpha^2 (1 - ln alpha).
const int MISSING_COLUMNS = 55;
const int MISSING_ROWS = 64;

// The least alpha that is looked up.
const float MISSING_ALPHA_MIN = 1.0e-3;

// A uniform block, since a device need not have a fifth storage block; four numbers an element, since std140 pads each to that.
layout(set = 0, binding = 20, std140) uniform MissingBlock {
    vec4 missing_table[896]; // 64 (55 + 1) / 4
};

float missing_entry(int row, int column) {
    int place = row * (MISSING_COLUMNS + 1) + column;
    return missing_table[place / 4][place % 4];
}

// Where alpha lies between rows.
float missing_row(float alpha) {
    return pow(alpha, 1.0 / 3.0) * float(MISSING_ROWS - 1);
}

// 1 - E of GGX for F = 1, towards a direction with that cosine, 0..1; alpha 0..1. Within 1e-3.
float ggx_missing(float cosine, float roughness) {
    float alpha = max(roughness, MISSING_ALPHA_MIN);
    float over = 1.0 / (cosine + alpha);
    float w = sqrt(alpha * (1.0 - cosine) * over);
    float x = sqrt(cosine * (1.0 + alpha) * over / (1.0 + w)) * float(MISSING_COLUMNS - 1);
    float y = missing_row(alpha);
    int column = min(int(x), MISSING_COLUMNS - 2);
    int row = min(int(y), MISSING_ROWS - 2);
    float along = x - float(column);
    float low = mix(missing_entry(row, column), missing_entry(row, column + 1), along);
    float high = mix(missing_entry(row + 1, column), missing_entry(row + 1, column + 1), along);
    return mix(low, high, y - float(row));
}

// Its mean over the cosine.
float ggx_missing_on_average(float roughness) {
    float alpha = max(roughness, MISSING_ALPHA_MIN);
    float y = missing_row(alpha);
    int row = min(int(y), MISSING_ROWS - 2);
    float over = mix(missing_entry(row, MISSING_COLUMNS), missing_entry(row + 1, MISSING_COLUMNS), y - float(row));
    return over * alpha * alpha * (1.0 - log(alpha));
}
