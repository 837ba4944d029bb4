// What does the slides' Cook-Torrance listing compute? To the letter, with its own names and its own faults.

// The listing's last value. It holds the cosine to the light already: D F G / (pi NdE), not divided by NdL.
// Left open by the deck: H and HdE stand on an earlier slide (the half vector; the Fresnel term), and NdL, NdE, R2
// in the Oren-Nayar listing; they are taken from there. Its F is Schlick's with F0 = FresnelScale.
// No guard is added: 0/0 where NdE or NdH is 0 or Roughness is 0, and pow of a negative base where HdE exceeds 1.
float SlidesCookTorrance(vec3 N, vec3 L, vec3 E, float Roughness, float FresnelScale) {
    float NdL = max( 0.0f, dot( N, L ) );
    float NdE = max( 0.0f, dot( N, E ) );
    float R2 = Roughness * Roughness;
    vec3 H = normalize( L + E ); // light and view half vector
    float HdE = dot( H, E );

    float NdH = max( 0.0f, dot( N, H ) );
    float NdH2 = NdH * NdH;
    float e = 2.71828182845904523536028747135f;
    float pi = 3.1415926535897932384626433832f;

    // Beckman's Distribution Function D
    float exponent = -(1 - NdH2) / (NdH2 * R2);
    float D = pow( e, exponent ) / (R2 * NdH2 * NdH2);

    // Fresnel Term F
    float F = mix( pow( 1 - HdE, 5 ), 1, FresnelScale );

    // Geometric Attenuation Factor G
    float X = 2.0f * NdH / dot( E, H );
    float G = min(1, min(X * NdL, X * NdE));

    // Calculate Cook-Torrance
    float CookTorrance = max( (D*G*F) / (NdE * pi), 0.0f );
    return CookTorrance;
}
