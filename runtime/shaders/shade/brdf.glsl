// The metallic-roughness BRDF of glTF 2.0, appendix B.
// GGX: B. Walter et al., 2007; height-correlated Smith: E. Heitz, 2014; Fresnel: C. Schlick, 1994.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided

const float kPi = 3.14159265358979;

struct Shading
{
    vec3 diffuse; // albedo of the diffuse part
    vec3 f0;
    float roughness; // perceptual
    vec3 normal;
    vec3 to_eye;
    float n_dot_v;
};

vec3 fresnelSchlick(vec3 f0, float v_dot_h)
{
    float x = 1.0 - v_dot_h;
    float x2 = x * x;
    return f0 + (1.0 - f0) * (x2 * x2 * x);
}

// Radiance towards the eye per irradiance from `to_light`, cosine included.
vec3 reflected(Shading s, vec3 to_light)
{
    float n_dot_l = dot(s.normal, to_light);
    if (n_dot_l <= 0.0)
        return vec3(0.0);
    vec3 half_vector = normalize(to_light + s.to_eye);
    float n_dot_h = clamp(dot(s.normal, half_vector), 0.0, 1.0);
    float v_dot_h = clamp(dot(s.to_eye, half_vector), 0.0, 1.0);

    float alpha = s.roughness * s.roughness;
    float alpha2 = alpha * alpha;
    float d = (n_dot_h * alpha2 - n_dot_h) * n_dot_h + 1.0;
    float distribution = alpha2 / (kPi * d * d);
    float visibility = 0.5 / (n_dot_l * sqrt(s.n_dot_v * s.n_dot_v * (1.0 - alpha2) + alpha2) +
                              s.n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0 - alpha2) + alpha2));
    vec3 fresnel = fresnelSchlick(s.f0, v_dot_h);
    return ((1.0 - fresnel) * s.diffuse / kPi + fresnel * distribution * visibility) * n_dot_l;
}

// Specular albedo under constant light, as scale and bias on f0. B. Karis, "Physically based shading on
// mobile", 2014: his fit to the split-sum table.
vec2 specularScaleBias(float roughness, float n_dot_v)
{
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * n_dot_v)) * r.x + r.y;
    return vec2(-1.04, 1.04) * a + r.zw;
}
