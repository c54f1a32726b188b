// Takes all values from the parameters: a material with it is one that has these factors.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
void values_of_parameters(inout MaterialValues values, MaterialPoint point)
{
    values.base_color = point.color * point.parameters[0].rgb;
    values.metallic = point.parameters[0].a;
    values.roughness = point.parameters[1].a;
    values.emission = point.parameters[1].rgb + point.inputs.xyz;
}
