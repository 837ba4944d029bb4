// What does the slides' Oren-Nayar listing compute? To the letter, with its own names and its own faults.

// The listing's last value: it replaces Phong's Lambertian term and holds the cosine to the light, not albedo / pi.
// Roughness is sigma, which Oren and Nayar 1994 mean in radians; the deck says 0 to 1.
// No guard is added: normalize(0) and acos above 1 are undefined where L or E is N.
float SlidesOrenNayar(vec3 N, vec3 L, vec3 E, float Roughness) {
    float NdL = max( 0.0f, dot( N, L ) );
    float NdE = max( 0.0f, dot( N, E ) );

    float R2 = Roughness * Roughness;

    // Oren-Nayar Diffuse Term
    float A = 1.0f - 0.5f * R2 / (R2 + 0.33f);
    float B = 0.45f * R2 / (R2 + 0.09f);

    // CX = Max(0, cos(l,e))
    vec3 lightProjected = normalize( L - N * NdL );
    vec3 viewProjected = normalize( E - N * NdE );
    float CX = max( 0.0f, dot( lightProjected, viewProjected ) );

    // DX = sin(alpha) * tan(beta)
    float alpha = sin( max( acos( NdE ), acos( NdL ) ) );
    float beta = tan( min( acos( NdE ), acos( NdL ) ) );
    float DX = alpha * beta;

    // Calculate Oren-Nayar, replaces the Phong Lambertian Term
    float OrenNayar = NdL * (A + B * CX * DX);
    return OrenNayar;
}
