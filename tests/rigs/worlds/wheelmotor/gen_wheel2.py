from gen_wheel import *
rec('w/n45b.tsv',45,0,-.955,10,71,800,fs=80); rec('w/n45bb.tsv',-45,0,-.955,10,72,900,fs=80)
rec('w/nidp.tsv',37.1,25.4,.955,10,73,1000,fs=80); rec('w/nidm.tsv',37.1,-25.4,.955,10,74,1100,fs=80)
