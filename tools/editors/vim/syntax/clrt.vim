" SPDX-License-Identifier: MIT
" Colors scenes of clrt (.scn). The first word of a line is a statement or an error; the other words
" are values.
if exists('b:current_syntax')
  finish
endif

" A path such as one/two.ply is one word.
syntax iskeyword @,48-57,_,-,.,/

syntax match clrtUnknown /^\s*\zs\S\+/ contains=clrtStatement nextgroup=clrtValues
syntax match clrtValues contained /\s.*/
      \ contains=clrtProperty,clrtConstant,clrtNumber,clrtString,clrtComment
syntax match clrtComment /\%(^\|\s\)\@1<=\%(#\|\/\/\).*/
syntax match clrtNumber contained
      \ /\%(^\|\s\)\@1<=[-+]\=\%(\d\+\.\=\d*\|\.\d\+\)\%([eE][-+]\=\d\+\)\=\%(\s\|$\)\@=/
syntax match clrtString contained /"[^"]*"/

syntax keyword clrtStatement contained ambient background camera define light material max_level
syntax keyword clrtStatement contained mesh normals ply_file sides size sphere sun up
syntax keyword clrtProperty contained diffuse checker specular kd ks shininess reflectivity color ior
syntax keyword clrtProperty contained up scale rotate translate
syntax keyword clrtConstant contained silhouette matte blinn_phong glass own one two smooth flat orthographic area

highlight default link clrtUnknown Error
highlight default link clrtStatement Statement
highlight default link clrtProperty Type
highlight default link clrtConstant Constant
highlight default link clrtNumber Number
highlight default link clrtString String
highlight default link clrtComment Comment

let b:current_syntax = 'clrt'
