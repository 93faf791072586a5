/// table.glsl - rows of four numbers that a model reads beside its parameters: lobes of a fit, measured values.
uniform samplerBuffer uBrdfTable;

vec4 table_row(int row) { return texelFetch(uBrdfTable, row); }
