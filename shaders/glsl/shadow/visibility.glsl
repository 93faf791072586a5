/// visibility.glsl - how much of a light reaches a point, by the method that the defines name for its type.
///
/// value  0..1
/// params slot      of the light's shadow, from its buffer; below 0: it casts none
///        wi_w      to the light, unit, world axes
///        distance  to the light, m
