"""Studies made with Hurcules, its evidence: the claims of the thesis and the field tests.

`hurcules_studies.thesis` measures what the thesis claims (`hurcules reproduce`);
`hurcules_studies.field_tests` holds test methods for response robots (`hurcules run e2803`).
Nothing in `hurcules` needs this package.
"""
